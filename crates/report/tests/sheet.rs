//! Every program of the corpus has a set-up sheet, in all faces, and its times add up.

mod shop;

use report::{Paint, Sheet, sheet_html, sheet_json, sheet_text};
use station::Library;

#[test]
fn every_program_of_the_corpus_has_a_sheet() {
    let configuration = shop::configuration();
    for (path, text) in shop::programs() {
        let mut session = shop::session(&configuration, &text);
        let sheet = Sheet::run(&mut session, |library, source, offset, len| {
            let mut bytes = Vec::new();
            let _ = library.read(source, offset, len, &mut bytes);
            bytes
        })
        .expect("the text can be read");
        let name = path.display();
        let json: serde_json::Value =
            serde_json::from_str(&sheet_json(&sheet)).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(json["tools"].is_array(), "{name}");
        let (total, tools): (f64, f64) = (sheet.times.total, sheet.tools.iter().map(|tool| tool.total).sum());
        assert!(tools <= total + 1e-6, "{name}: the tools take {tools} s of {total} s");
        let cutting: f64 = sheet.tools.iter().map(|tool| tool.cutting).sum();
        assert!((cutting - sheet.times.cutting).abs() < 1e-6, "{name}: {cutting} s of {} s", sheet.times.cutting);
        let html = sheet_html(&sheet);
        assert!(html.ends_with("</html>\n") && !html.contains("http"), "{name}");
        for tag in ["section", "table", "div", "ul", "p"] {
            let count = |part: String| html.matches(&part).count();
            let open = count(format!("<{tag}>")) + count(format!("<{tag} "));
            assert_eq!(open, count(format!("</{tag}>")), "{name}: <{tag}>");
        }
        let page = sheet_text(&sheet, Paint { colour: false, width: 80 });
        let long = page.lines().find(|line| line.chars().count() > 96 && line.starts_with("  "));
        assert_eq!(long, None, "{name}");
    }
}
