//! Every block of the corpus can be explained, in both faces.

mod shop;

use report::{Excerpt, Paint, Wanted, Watch, explain, explanation_json, explanation_text};
use station::AfterAlarm;

#[test]
fn every_block_of_the_corpus_can_be_explained() {
    let configuration = shop::configuration();
    let (control, axes) = (&configuration.control, &configuration.machine.axes);
    let mut blocks = 0;
    for (path, text) in shop::programs() {
        let mut session = shop::session(&configuration, &text);
        session.set_after_alarm(AfterAlarm::GoOn);
        let watch = Watch::run(&mut session, Wanted::All).expect("the text can be read");
        for watched in watch.found.iter().take(200) {
            let (from, len) = (watched.place.block.start as usize, watched.place.block.len as usize);
            let alarm = watched.alarm.map(|alarm| {
                let excerpt = Excerpt::new("in.nc", alarm.place.line, b"", 1, 0);
                (control.diagnose(&alarm, "", None), excerpt)
            });
            let explanation = explain(&session, watched, "in.nc", &text[from..from + len], alarm);
            let json = explanation_json(&explanation, control, axes);
            let value: serde_json::Value =
                serde_json::from_str(&json).unwrap_or_else(|error| panic!("{}: {error}: {json}", path.display()));
            assert_eq!(value["line"], watched.place.line, "{}", path.display());
            let written = explanation.words.iter().filter(|word| !word.word.starts_with('(')).count();
            assert!(written > 0, "{}:{} has words: {json}", path.display(), watched.place.line);
            let page = explanation_text(&explanation, control, axes, Paint { colour: false, width: 80 });
            let long = |line: &&str| line.chars().count() > 80 && !line.contains("= ") && !line.contains(" | ");
            // The block itself and the alarm's sentences may be longer.
            let list = page.lines().skip(4).find(|line| long(line) && line.starts_with("  "));
            assert_eq!(list, None, "{}:{}", path.display(), watched.place.line);
            blocks += 1;
        }
    }
    assert!(blocks > 1000, "{blocks} blocks");
}
