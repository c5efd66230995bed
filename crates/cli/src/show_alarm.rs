//! An alarm or a warning with its source line.

use base::{Alarm, Diagnostic, Place, Severity, Span};
use dialect::Control;
use machine::MachineFile;
use report::{Excerpt, Format, render};
use warnings::Finding;

use crate::output::{colour_err, say};
use crate::texts::Texts;

/// Longest stretch of a line that is read to show it.
const LINE: usize = 16 * 1024;

/// The alarm about a block typed at the panel in words, and that block.
pub fn show_typed_alarm(
    alarm: &Alarm,
    control: &Control,
    machine: &MachineFile,
    typed: &[u8],
) -> (Diagnostic, Excerpt) {
    let from = usize::try_from(alarm.place.line_start).unwrap_or(usize::MAX).min(typed.len());
    show("MDI", alarm, control, machine, &typed[from..])
}

/// The alarm in words, and the line it stands on.
pub fn show_alarm(alarm: &Alarm, control: &Control, machine: &MachineFile, texts: &mut Texts) -> (Diagnostic, Excerpt) {
    let bytes = line_of(&alarm.place, alarm.span, texts);
    show(texts.name(alarm.place.source), alarm, control, machine, &bytes)
}

/// Says the alarm on standard error, with the line it stands on: both are given back.
pub fn tell_alarm(alarm: &Alarm, control: &Control, machine: &MachineFile, texts: &mut Texts) -> (Diagnostic, Excerpt) {
    let (diagnostic, excerpt) = show_alarm(alarm, control, machine, texts);
    say(&render(&diagnostic, &excerpt, Format::Text { colour: colour_err() }));
    (diagnostic, excerpt)
}

/// `bytes` begin with the alarm's line.
fn show(file: &str, alarm: &Alarm, control: &Control, machine: &MachineFile, bytes: &[u8]) -> (Diagnostic, Excerpt) {
    let column = alarm.place.column(alarm.span);
    let excerpt = Excerpt::new(file, alarm.place.line, bytes, column, alarm.span.len);
    let axis = alarm.axis.and_then(|axis| machine.axes.get(usize::from(axis)));
    let axis = axis.map(|axis| (char::from(axis.letter), axis.rotary));
    let word = machine.words_of(alarm);
    (control.diagnose(alarm, word.as_deref().unwrap_or(&excerpt.word), axis), excerpt)
}

/// The warning in words, the line it stands on and those of its labels; `None` if the block itself allows it.
pub fn show_warning(
    finding: &Finding,
    control: &Control,
    widest: f64,
    severity: Severity,
    texts: &mut Texts,
) -> Option<(Diagnostic, Excerpt, Vec<Excerpt>)> {
    let block = finding.place.block;
    let bytes = texts.excerpt(finding.place.source, block.start, block.len as usize);
    let diagnostic = finding.show(control, &bytes, widest, severity)?;
    let found = excerpt(&diagnostic.place, diagnostic.span, texts);
    let labels = diagnostic.labels.iter().map(|label| excerpt(&label.place, label.span, texts)).collect();
    Some((diagnostic, found, labels))
}

fn excerpt(place: &Place, span: Span, texts: &mut Texts) -> Excerpt {
    let bytes = line_of(place, span, texts);
    Excerpt::new(texts.name(place.source), place.line, &bytes, place.column(span), span.len)
}

/// The line of a place, as far as it is shown.
fn line_of(place: &Place, span: Span, texts: &mut Texts) -> Vec<u8> {
    let column = place.column(span);
    texts.excerpt(place.source, place.line_start, LINE.max((column as usize).min(1 << 20) + 256))
}
