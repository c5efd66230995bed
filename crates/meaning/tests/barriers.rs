//! The interpreter pulled by hand: its questions, stale answers, answers in parts, the two states.

use std::sync::Arc;

use base::SourceId;
use dialect::{Fitting, builtin_files, load_control};
use meaning::{
    Act, Answer, AxisFacts, BarrierKind, Close, CodeRules, Interpreter, MachineFacts, Memory, OffsetTable, Pull,
    StaleBarrier, Variables,
};

fn interpreter() -> Interpreter {
    let files = builtin_files("yasnac-mx1").expect("it is built in");
    let control = Arc::new(load_control(&files).expect("it is right"));
    let axis = |letter| AxisFacts { letter, rotary: false, reference_points: [0.0; 4], approach: 0.0 };
    let facts = MachineFacts {
        axes: b"XYZ".iter().map(|&letter| axis(letter)).collect(),
        codes: CodeRules { digits: [2, 4, 2, 3], m_after_motion: vec![5, 6, 9], b_after_motion: false },
        kinematics: None,
    };
    let variables = Variables::new(&control.user_macro, control.macro_levels);
    let memory =
        Memory { lengths: OffsetTable::new(99), radii: None, variables, work: [[0.0; 8]; 6], external: [0.0; 8] };
    let fitting = Fitting::stock(&control);
    let mut interpreter = Interpreter::new(control, fitting, facts, memory, &[0.0; 8], [0.0; 8]);
    interpreter.select(SourceId(0), "TEST");
    interpreter
}

/// Pulls until a block closes or something else than bytes is asked; says what came.
fn next(interpreter: &mut Interpreter, text: &[u8], part: usize) -> String {
    loop {
        let barrier = match interpreter.next() {
            Pull::Item(operation) => match operation.act {
                Act::Close(Close::Next) => continue,
                act => return format!("{}: {act:?}", operation.place.line),
            },
            Pull::End => return "end".to_owned(),
            Pull::Barrier(barrier) => barrier,
        };
        let BarrierKind::NeedBytes { offset, len, .. } = barrier.kind else { return format!("{:?}", barrier.kind) };
        let from = (offset as usize).min(text.len());
        let to = text.len().min(from + len.min(part));
        interpreter.resume(barrier.id, Answer::Bytes(&text[from..to], to == text.len())).expect("it is open");
    }
}

fn all(text: &[u8], part: usize) -> Vec<String> {
    let mut interpreter = interpreter();
    let mut out = Vec::new();
    while out.len() < 100 {
        let said = next(&mut interpreter, text, part);
        let done = said == "end" || said == "CycleStart";
        out.push(said);
        if done {
            break;
        }
    }
    out
}

#[test]
fn an_answer_to_another_question_is_refused_and_changes_nothing() {
    let mut interpreter = interpreter();
    let Pull::Barrier(first) = interpreter.next() else { panic!("the text is asked for first") };
    assert_eq!(interpreter.resume(first.id + 1, Answer::Bytes(b"G28X0\n", true)), Err(StaleBarrier));
    assert_eq!(interpreter.resume(first.id, Answer::Bytes(b"G00X1.\n", true)), Ok(()));
    assert_eq!(interpreter.resume(first.id, Answer::Bytes(b"G28X0\n", true)), Err(StaleBarrier));
    assert!(next(&mut interpreter, b"", 1).starts_with("0: Start"));
    assert!(next(&mut interpreter, b"", 1).starts_with("1: Rapid"));
}

#[test]
fn answers_in_parts_of_any_size_lead_to_the_same_operations() {
    let text = b"\xEF\xBB\xBF%\r\nO1\r\nG91G00X1.;Y2.\r\nM98P2L2\r\nM30\r\nO2\r\nG01Z-1.F100\r\nM99\r\n%";
    let whole = all(text, usize::MAX);
    assert!(whole.len() > 6, "{whole:?}");
    for part in 1..text.len() {
        assert_eq!(all(text, part), whole, "parts of {part}");
    }
}

#[test]
fn nothing_is_read_past_a_program_stop_and_start_is_asked_for() {
    let mut interpreter = interpreter();
    let text = b"G91\nX1.M00\nG90\n";
    let mut said = String::new();
    while !said.contains("Stop") {
        said = next(&mut interpreter, text, 1000);
    }
    assert_eq!(interpreter.read_state().groups, interpreter.executing_state().groups, "G90 has not been read");
    assert_eq!(next(&mut interpreter, text, 1000), "CycleStart");
    let Pull::Barrier(barrier) = interpreter.next() else { panic!("the question stays") };
    interpreter.resume(barrier.id, Answer::Continue).expect("it is open");
    assert!(next(&mut interpreter, text, 1000).contains("End"));
    let distance = interpreter.control().roles.distance;
    let row = interpreter.read_state().groups.0[distance];
    assert_eq!(interpreter.control().g_name(row), "G90", "after the start it is");
}

#[test]
fn reset_goes_back_to_the_state_of_the_block_being_executed() {
    let mut interpreter = interpreter();
    let text = b"G91 G00 X1.\nG90\nG01 F100\nX5.\nX6.\n";
    next(&mut interpreter, text, 1000);
    assert!(next(&mut interpreter, text, 1000).starts_with("1: Rapid"));
    let distance = interpreter.control().roles.distance;
    let name = |interpreter: &Interpreter, row: u8| interpreter.control().g_name(row);
    assert_eq!(name(&interpreter, interpreter.read_state().groups.0[distance]), "G90", "two blocks are read ahead");
    assert_eq!(name(&interpreter, interpreter.executing_state().groups.0[distance]), "G91");
    interpreter.reset(dialect::Occasion::Reset, &[0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], false);
    assert_eq!(name(&interpreter, interpreter.read_state().groups.0[distance]), "G91", "what was read is dropped");
    assert_eq!(interpreter.read_state().machine[0], 500_000.0, "the axes stand where they really are");
}

#[test]
fn a_skip_move_goes_on_from_where_the_machine_says_it_stands() {
    let text = b"G31 X10. F100\nG91 G01 X1.\nM30\n";
    let second_move = |answer: Answer| {
        let mut interpreter = interpreter();
        next(&mut interpreter, text, 1000);
        assert!(next(&mut interpreter, text, 1000).starts_with("1: Line"));
        assert_eq!(next(&mut interpreter, text, 1000), "SkipPosition");
        let distance = interpreter.control().roles.distance;
        let row = interpreter.read_state().groups.0[distance];
        assert_eq!(interpreter.control().g_name(row), "G90", "the second block has not been read");
        let Pull::Barrier(barrier) = interpreter.next() else { panic!("the question stays") };
        interpreter.resume(barrier.id, answer).expect("it is open");
        let state = interpreter.read_state();
        assert_eq!(state, interpreter.executing_state());
        let places = [state.machine[0], state.skip[0]];
        let Pull::Item(_) = interpreter.next() else { panic!("the block closes") };
        (places, next(&mut interpreter, text, 1000))
    };
    let mut at = [0.0; 8];
    at[0] = 7.25;
    let (places, second) = second_move(Answer::Stands(at, true));
    assert_eq!(places, [7_250_000.0; 2]);
    assert!(second.starts_with("2: Line { to: [8.25,"), "{second}");
    let (_, second) = second_move(Answer::Stop);
    assert!(second.starts_with("2: Line { to: [11.0,"), "without an answer it has gone to its end: {second}");
}
