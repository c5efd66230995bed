//! The faces of a diagnostic: for people at a terminal, as JSON, as SARIF, as annotations of a forge.

use std::collections::BTreeMap;

use annotate_snippets::{Annotation, AnnotationKind, Level, Renderer, Snippet};
use base::{Correction, Diagnostic, Label, Severity};
use dialect::Control;

use crate::excerpt::Excerpt;
use crate::json::JsonLine;

/// How diagnostics are shown.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Format {
    /// For people; in colour if asked for.
    Text {
        /// With colour.
        colour: bool,
    },
    /// A JSON array of objects.
    Json,
    /// SARIF 2.1.0.
    Sarif,
    /// Workflow commands that a forge shows beside the line.
    Github,
}

/// What stands before the first diagnostic.
pub fn begin(format: Format) -> &'static str {
    match format {
        Format::Json => "[",
        Format::Sarif => concat!(
            "{\"$schema\":\"https://json.schemastore.org/sarif-2.1.0.json\",\"version\":\"2.1.0\",",
            "\"runs\":[{\"results\":["
        ),
        Format::Text { .. } | Format::Github => "",
    }
}

/// What stands between two diagnostics.
pub fn separator(format: Format) -> &'static str {
    match format {
        Format::Json | Format::Sarif => ",\n",
        Format::Text { .. } => "\n",
        Format::Github => "",
    }
}

/// What stands after the last diagnostic.
pub fn end(format: Format, rules: &Rules) -> String {
    match format {
        Format::Json => "]\n".to_owned(),
        Format::Sarif => rules.sarif(),
        Format::Text { .. } | Format::Github => String::new(),
    }
}

/// What was told of, each once by its code: what it is, why the machine cares, what to do.
#[derive(Debug, Default)]
pub struct Rules(BTreeMap<&'static str, [String; 3]>);

impl Rules {
    /// Takes in what a diagnostic of this control tells of.
    pub fn take_in(&mut self, code: &'static str, control: &Control) {
        self.0.entry(code).or_insert_with(|| control.sentences_of(code));
    }

    /// The end of a SARIF log: the tool, with the rules that its results name.
    fn sarif(&self) -> String {
        let mut out = b"],\"tool\":".to_vec();
        let mut tool = JsonLine::begin(&mut out);
        tool.object("driver", |driver| {
            driver.text("name", "cyclestart").text("version", env!("CARGO_PKG_VERSION"));
            let rules = driver.field("rules");
            rules.push(b'[');
            for (index, (code, sentences)) in self.0.iter().enumerate() {
                if index > 0 {
                    rules.push(b',');
                }
                let mut rule = JsonLine::begin(rules);
                rule.text("id", code);
                for (name, text) in ["shortDescription", "fullDescription", "help"].into_iter().zip(sentences) {
                    rule.object(name, |message| {
                        message.text("text", &sentence(text));
                    });
                }
                rule.end();
            }
            rules.push(b']');
        });
        tool.end();
        out.extend_from_slice(b"}]}\n");
        String::from_utf8_lossy(&out).into_owned()
    }
}

/// A diagnostic in one of its faces.
pub fn render(diagnostic: &Diagnostic, excerpt: &Excerpt, format: Format) -> String {
    render_with_labels(diagnostic, excerpt, &[], format)
}

/// The same with the excerpts of its labels, in their order.
pub fn render_with_labels(diagnostic: &Diagnostic, excerpt: &Excerpt, labels: &[Excerpt], format: Format) -> String {
    match format {
        Format::Text { colour } => text(diagnostic, excerpt, labels, colour),
        Format::Json => json(diagnostic, excerpt, labels),
        Format::Sarif => sarif(diagnostic, excerpt, labels),
        Format::Github => github(diagnostic, excerpt),
    }
}

fn text(diagnostic: &Diagnostic, excerpt: &Excerpt, labels: &[Excerpt], colour: bool) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let name = match &diagnostic.alarm {
        Some(alarm) => match alarm.number {
            Some(number) => format!("alarm {} ({number:03})", alarm.name),
            None => format!("alarm {}", alarm.name),
        },
        None => diagnostic.label.clone(),
    };
    let mut group = level.primary_title(&diagnostic.message).id(diagnostic.code).element(snippet(
        excerpt,
        AnnotationKind::Primary,
        &name,
    ));
    for (label, excerpt) in diagnostic.labels.iter().zip(labels) {
        group = group.element(snippet(excerpt, AnnotationKind::Context, &label.text));
    }
    let mut group = group
        .element(Level::NOTE.with_name("why").message(&diagnostic.why))
        .element(Level::HELP.message(&diagnostic.help));
    if let Some(fix) = &diagnostic.fix {
        group = group.element(Level::HELP.message(in_words(fix)));
    }
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    format!("{}\n", renderer.render(&[group]))
}

/// A correction for people.
fn in_words(fix: &Correction) -> String {
    let blocks = fix.text.replace('\n', ", then ");
    match (fix.safe, blocks.is_empty()) {
        (true, _) => format!("write {blocks}"),
        (false, false) => format!("perhaps {blocks} is meant"),
        (false, true) => "perhaps nothing is meant: delete the block".to_owned(),
    }
}

/// A source line with what is meant in it.
fn snippet<'s>(excerpt: &'s Excerpt, kind: AnnotationKind, label: &'s str) -> Snippet<'s, Annotation<'s>> {
    let mut annotation = kind.span(excerpt.from..excerpt.to);
    if !label.is_empty() {
        annotation = annotation.label(label);
    }
    let line = usize::try_from(excerpt.line).unwrap_or(usize::MAX);
    Snippet::source(&excerpt.text).line_start(line).path(&excerpt.file).annotation(annotation)
}

fn json(diagnostic: &Diagnostic, excerpt: &Excerpt, labels: &[Excerpt]) -> String {
    let mut out = Vec::new();
    let mut line = JsonLine::begin(&mut out);
    line.text("file", &excerpt.file)
        .integer("line", excerpt.line)
        .integer("column", excerpt.column)
        .integer("offset", diagnostic.span.start)
        .integer("length", u64::from(diagnostic.span.len))
        .text("severity", diagnostic.severity.name())
        .text("code", diagnostic.code);
    if let Some(alarm) = &diagnostic.alarm {
        line.text("alarm", &alarm.name);
        if let Some(number) = alarm.number {
            line.integer("number", u64::from(number));
        }
    }
    line.text("word", &excerpt.word)
        .text("message", &diagnostic.message)
        .text("why", &diagnostic.why)
        .text("help", &diagnostic.help);
    if !diagnostic.label.is_empty() {
        line.text("label", &diagnostic.label);
    }
    if !labels.is_empty() {
        objects(line.field("labels"), diagnostic, labels, |object, label, excerpt| {
            object.text("file", &excerpt.file).integer("line", excerpt.line).integer("column", excerpt.column);
            object.text("text", &label.text);
        });
    }
    if let Some(fix) = &diagnostic.fix {
        line.object("fix", |object| {
            object.text("applicability", if fix.safe { "safe" } else { "unsafe" });
            object.integer("offset", fix.span.start).integer("length", u64::from(fix.span.len));
            object.text("text", &fix.text);
        });
    }
    line.end();
    String::from_utf8_lossy(&out).into_owned()
}

/// An array of one object a label.
fn objects(
    out: &mut Vec<u8>,
    diagnostic: &Diagnostic,
    excerpts: &[Excerpt],
    write: impl Fn(&mut JsonLine, &Label, &Excerpt),
) {
    out.push(b'[');
    for (index, (label, excerpt)) in diagnostic.labels.iter().zip(excerpts).enumerate() {
        if index > 0 {
            out.push(b',');
        }
        let mut object = JsonLine::begin(out);
        write(&mut object, label, excerpt);
        object.end();
    }
    out.push(b']');
}

fn sarif(diagnostic: &Diagnostic, excerpt: &Excerpt, labels: &[Excerpt]) -> String {
    let mut out = Vec::new();
    let mut line = JsonLine::begin(&mut out);
    line.text("ruleId", diagnostic.code).text("level", diagnostic.severity.name());
    line.object("message", |message| {
        let text = format!("{}. {} {}", diagnostic.message, sentence(&diagnostic.why), sentence(&diagnostic.help));
        message.text("text", &text);
    });
    let location = line.field("locations");
    location.push(b'[');
    let mut object = JsonLine::begin(location);
    physical_location(&mut object, excerpt, diagnostic.span.len);
    object.end();
    location.push(b']');
    if !labels.is_empty() {
        objects(line.field("relatedLocations"), diagnostic, labels, |object, label, excerpt| {
            physical_location(object, excerpt, label.span.len);
            object.object("message", |message| {
                message.text("text", &label.text);
            });
        });
    }
    if let Some(fix) = &diagnostic.fix {
        let fixes = line.field("fixes");
        fixes.push(b'[');
        sarif_fix(fixes, fix, diagnostic, excerpt);
        fixes.push(b']');
    }
    line.end();
    String::from_utf8_lossy(&out).into_owned()
}

fn sarif_fix(out: &mut Vec<u8>, fix: &Correction, diagnostic: &Diagnostic, excerpt: &Excerpt) {
    let mut object = JsonLine::begin(out);
    object.object("description", |message| {
        message.text("text", &sentence(&in_words(fix)));
    });
    let changes = object.field("artifactChanges");
    changes.push(b'[');
    let mut change = JsonLine::begin(changes);
    change.object("artifactLocation", |artifact| {
        artifact.text("uri", &excerpt.file);
    });
    let replacements = change.field("replacements");
    replacements.push(b'[');
    let mut replacement = JsonLine::begin(replacements);
    let column = diagnostic.place.column(fix.span);
    replacement.object("deletedRegion", |region| {
        region.integer("startLine", excerpt.line).integer("startColumn", column);
        region.integer("endColumn", column + u64::from(fix.span.len));
    });
    replacement.object("insertedContent", |content| {
        content.text("text", &fix.text);
    });
    replacement.end();
    replacements.push(b']');
    change.end();
    changes.push(b']');
    object.end();
}

fn physical_location(object: &mut JsonLine, excerpt: &Excerpt, width: u32) {
    object.object("physicalLocation", |physical| {
        physical.object("artifactLocation", |artifact| {
            artifact.text("uri", &excerpt.file);
        });
        physical.object("region", |region| {
            region.integer("startLine", excerpt.line).integer("startColumn", excerpt.column);
            region.integer("endColumn", excerpt.column + u64::from(width));
        });
    });
}

fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|letter| letter.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", letters.as_str().trim_end_matches('.'))
}

fn github(diagnostic: &Diagnostic, excerpt: &Excerpt) -> String {
    let escape = |text: &str| text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A");
    let property = |text: &str| escape(text).replace(':', "%3A").replace(',', "%2C");
    let Excerpt { file, line, column, .. } = excerpt;
    format!(
        "::{} file={},line={line},col={column},title={}::{}%0A{}%0A{}\n",
        diagnostic.severity.name(),
        property(file),
        property(diagnostic.code),
        escape(&diagnostic.message),
        escape(&diagnostic.why),
        escape(&diagnostic.help),
    )
}
