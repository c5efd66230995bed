//! `plot`: the tool path as a picture.

mod chart;
mod driven;
mod strokes;
mod timing;

use machine::EventKind;
use meaning::CodeLine;
use plot::{Drawing, Look, Mark, MarkKind, Title};

use self::driven::Driven;
use self::strokes::{Strokes, layer};
use super::{name_of, open, run_through};
use crate::arguments::{LayerArgument, PlotArguments, ViewArgument};
use crate::failure::Failure;
use crate::output::write_file;
use crate::show_alarm::tell_alarm;

/// What a picture can be.
enum Picture {
    Svg,
    Png,
}

/// The machine code that changes tools, by custom of the trade; the mark stands where it is sent.
const TOOL_CHANGE: u32 = 6;

pub fn plot(arguments: &PlotArguments) -> Result<bool, Failure> {
    let output = &arguments.output;
    let ending = output.extension().map_or(String::new(), |ending| ending.to_string_lossy().to_lowercase());
    let picture = match ending.as_str() {
        "svg" => Picture::Svg,
        "png" => Picture::Png,
        "html" => return Err(Failure::call("the HTML viewer is not built yet; write .svg or .png")),
        _ => return Err(Failure::call(format!("{}: end the picture's name with .svg or .png", output.display()))),
    };
    if arguments.chart {
        return chart::chart(arguments, picture);
    }
    if arguments.timing {
        return timing::timing(arguments, picture);
    }
    agrees(arguments)?;
    let mut session = open(&arguments.file, &arguments.setting)?;
    let mut driven = Driven::new(&arguments.layers, arguments.around.map(|window| window.1), arguments.exaggerate);
    if driven.is_wanted() {
        session.plan_ahead_in_detail();
    }
    let configuration = session.configuration().clone();
    let (control, machine) = (&configuration.control, &configuration.machine);
    let strokes = Strokes::new(machine);
    let layers: Vec<_> = arguments.layers.iter().map(|argument| layer(*argument)).collect();
    let mut drawing: Option<Drawing> = None;
    let title = |program: &str| Title {
        program: program.to_owned(),
        control: control.title.clone(),
        machine: machine.name.clone(),
    };
    let (mut tool, mut alarmed, mut runs_along) = (0, false, false);
    run_through(&mut session, arguments.setting.repeat, |session, event| {
        let position = strokes.at(&session.position());
        let drawing = drawing.get_or_insert_with(|| {
            let mut drawing = Drawing::new(title(name_of(session, event.place.program)));
            drawing.show(&layers);
            drawing.look(look(arguments));
            drawing.exaggerate(arguments.exaggerate);
            drawing
        });
        if let Some(stroke) = strokes.of_event(&event.kind, tool) {
            driven.draw(drawing, &strokes, session, &event.kind, &stroke);
            runs_along |= strokes.beside(drawing, session.beside(), &event.kind, &stroke);
        }
        if event.kind == EventKind::BlockDone && !std::mem::take(&mut runs_along) {
            // Beside an arc as large as the tool nothing moves.
            let block = session.interpreter().executing();
            let position = session.position();
            let ways = block.into_iter().flat_map(|block| strokes.ways_of(block, &position));
            ways.for_each(|way| drawing.programmed(&way));
        }
        if let EventKind::Alarm(alarm) = &event.kind {
            strokes.refused(drawing, session, alarm);
        }
        let mut mark = |kind, text: String| drawing.mark(Mark { at: position, kind, text });
        match &event.kind {
            EventKind::Start(_) => mark(MarkKind::Start, String::new()),
            EventKind::Code(code) if code.line == CodeLine::T => tool = code.code,
            EventKind::Code(code) if code.line == CodeLine::M && code.code == TOOL_CHANGE => {
                mark(MarkKind::ToolChange(tool), String::new());
            }
            EventKind::Stop(_) => mark(MarkKind::Stop, String::new()),
            EventKind::End { .. } => mark(MarkKind::End, String::new()),
            EventKind::Alarm(alarm) => {
                alarmed = true;
                let (diagnostic, _) = tell_alarm(alarm, control, machine, session.library_mut());
                mark(MarkKind::Alarm, diagnostic.alarm.map_or_else(String::new, |alarm| alarm.name));
            }
            _ => {}
        }
        Ok(())
    })?;
    let drawing = drawing.unwrap_or_else(|| Drawing::new(title("")));
    picture.write(arguments, &drawing.svg())?;
    Ok(!alarmed)
}

impl Picture {
    /// Writes the picture that this SVG is.
    fn write(&self, arguments: &PlotArguments, svg: &str) -> Result<(), Failure> {
        let png;
        let bytes = match self {
            Picture::Svg => svg.as_bytes(),
            Picture::Png => {
                png = plot::png(svg, arguments.width).map_err(Failure::call)?;
                &png
            }
        };
        write_file(&arguments.output, bytes, &arguments.setting.files(&arguments.file))
    }
}

/// Refuses what contradicts itself.
fn agrees(arguments: &PlotArguments) -> Result<(), Failure> {
    let has = |layer| arguments.layers.contains(&layer);
    let wrong = if has(LayerArgument::Speed) && has(LayerArgument::Actual) {
        "layer speed colours the path that is driven, layer actual draws it beside another: choose one of them"
    } else if has(LayerArgument::Speed) && has(LayerArgument::Compensated) {
        "layer speed is the path of layer compensated in other colours: choose one of them"
    } else if arguments.exaggerate != 1.0 && !has(LayerArgument::Actual) {
        "--exaggerate draws the deviation of layer actual larger: add --layers programmed,actual"
    } else {
        return Ok(());
    };
    Err(Failure::call(wrong))
}

/// From where the path is seen.
fn look(arguments: &PlotArguments) -> Look {
    match (arguments.around, arguments.view) {
        (Some(window), _) => Look::Around(window.0, window.1),
        (None, ViewArgument::Plan) => Look::Plan,
        (None, ViewArgument::Both) => Look::Both,
    }
}
