//! How every line between control and machine stands, for whoever looks at it: nothing is changed by a look.

use base::AXES;
use dialect::AddressKind;
use machine::Signal;

use super::Session;
use crate::library::Library;

impl<L: Library> Session<L> {
    /// Shows every line and how it stands: codes, strobes and answers, inputs, what the spindle's drive says, overtravel
    /// switches, dogs. Those that the builder has named are shown by [`Session::logic_lines`].
    pub fn see_lines(&self, see: &mut dyn FnMut(Signal, bool)) {
        let (facts, inputs) = (self.interpreter().facts(), &self.inputs);
        let mut digits = facts.codes.digits;
        let control = &self.configuration.control;
        let is_code = control.address(b'B').is_some_and(|address| address.kind == AddressKind::Code);
        if !is_code || facts.axis(b'B').is_some() || !self.interpreter().fitting().options.b_function {
            // Where B is no code there are no lines for it.
            digits[3] = 0;
        }
        self.machine.see_code_lines(digits, &mut |signal, driven| match signal {
            Signal::Eop => see(signal, inputs.eop.unwrap_or(driven)),
            Signal::Rwd => see(signal, inputs.rwd.unwrap_or(driven)),
            _ => see(signal, driven),
        });
        see(Signal::Skip, inputs.skip);
        see(Signal::Interrupt, inputs.interrupt);
        self.machine.see_spindle_lines(see);
        let position = self.position();
        let switches = self.machine.switches();
        for (index, switch) in switches.iter().enumerate() {
            // Two switches may share a line.
            let same = |other: &&machine::LimitSwitch| other.signal() == switch.signal();
            if !switches.iter().take(index).any(|other| same(&other)) {
                see(switch.signal(), switches.iter().filter(same).any(|other| other.is_on(&position)));
            }
        }
        for (index, axis) in self.configuration.machine.axes.iter().enumerate().take(AXES) {
            if let Some(dog) = &axis.reference_return {
                let point = axis.reference_points.first().copied().unwrap_or(0.0);
                see(Signal::Deceleration(index as u8), dog.is_on_dog(point, position[index]));
            }
        }
    }

    /// The inputs that macros read and the outputs that they switch, a bit each, and how many the control has of both.
    pub fn interface_bits(&self) -> [(u32, u32); 2] {
        let interpreter = self.interpreter();
        let count = |meaning| {
            let range = interpreter.control().user_macro.range_of(meaning);
            range.map_or(0, |(from, to)| (to + 1).saturating_sub(from).min(u32::BITS))
        };
        [
            (self.inputs.interface, count(dialect::VariableMeaning::InputBit)),
            (interpreter.memory().variables.outputs, count(dialect::VariableMeaning::OutputBit)),
        ]
    }
}
