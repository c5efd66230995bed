//! The set-up sheet as one JSON object: seconds, mm, mm/min.

use super::{Sheet, Spot, ToolSheet};
use crate::json::{JsonLine, push_number, push_text};
use crate::trace::end_name;

/// The sheet as one JSON object.
pub fn sheet_json(sheet: &Sheet) -> String {
    let mut out = Vec::new();
    let mut object = JsonLine::begin(&mut out);
    object.text("program", &sheet.program).text("control", &sheet.control).text("machine", &sheet.machine);
    texts(&mut object, "header", &sheet.header);
    match sheet.end {
        Some(end) => object.text("end", end_name(end)),
        None => {
            object.field("end").extend_from_slice(b"null");
            &mut object
        }
    };
    if let Some(alarm) = &sheet.alarm_text {
        object.text("alarm", alarm);
    }
    object.object("cycle_time", |time| {
        let times = sheet.times;
        time.number("total", times.total).number("cutting", times.cutting).number("rapid", times.rapid);
        time.number("dwell", times.dwell).number("waiting", times.waiting);
    });
    list(&mut object, "tools", &sheet.tools, tool);
    list(&mut object, "offsets", &sheet.offsets, |offset, line| {
        line.text("offset", &format!("{}{:02}", offset.letter, offset.number)).number("value", offset.value);
        line.boolean("set", !super::text::missing(offset));
        tools(line, &offset.tools);
    });
    list(&mut object, "work_systems", &sheet.systems, |system, line| {
        line.text("system", &system.name);
        line.object("origin", |origin| axes(origin, &system.origin));
        line.boolean("set", !super::text::unset(system)).boolean("base", system.base);
        spot(line, &system.first);
    });
    list(&mut object, "start_positions", &sheet.starts, |start, line| {
        spot(line, &start.spot);
        let at: Vec<_> = start.axes.iter().map(|(axis, at, _)| (*axis, *at)).collect();
        line.object("machine", |machine| axes(machine, &at));
        let by_hand: String = start.axes.iter().filter(|(.., hand)| *hand).map(|(axis, ..)| *axis).collect();
        line.text("put_by_hand", &by_hand);
    });
    object.object("travel", |travel| {
        for (axis, used, limits) in &sheet.travel {
            travel.object(&axis.to_ascii_lowercase().to_string(), |line| {
                pair(line, "used", *used);
                pair(line, "limits", *limits);
            });
        }
    });
    list(&mut object, "codes", &sheet.codes, |code, line| {
        line.text("code", &code.name).integer("count", code.count);
        spot(line, &code.first);
        line.boolean("builder", code.text.is_none());
        if let Some(text) = &code.text {
            line.text("text", text);
        }
    });
    list(&mut object, "stops", &sheet.stops, |stop, line| {
        line.text("code", stop.name).text("remark", &stop.remark).integer("count", stop.count);
        spot(line, &stop.spot);
    });
    list(&mut object, "subprograms", &sheet.called, |called, line| {
        line.text("called", &called.name).integer("runs", called.runs);
        spot(line, &called.first);
    });
    let options: Vec<String> = sheet.options.iter().map(|(name, _)| name.clone()).collect();
    texts(&mut object, "options", &options);
    texts(&mut object, "writes", &sheet.writes);
    object.end();
    String::from_utf8_lossy(&out).into_owned()
}

fn list<T>(object: &mut JsonLine, name: &str, items: &[T], write: impl Fn(&T, &mut JsonLine)) {
    let out = object.field(name);
    out.push(b'[');
    for (index, item) in items.iter().enumerate() {
        if index > 0 {
            out.push(b',');
        }
        let mut line = JsonLine::begin(out);
        write(item, &mut line);
        line.end();
    }
    out.push(b']');
}

fn texts(object: &mut JsonLine, name: &str, items: &[String]) {
    let out = object.field(name);
    out.push(b'[');
    for (index, item) in items.iter().enumerate() {
        if index > 0 {
            out.push(b',');
        }
        push_text(out, item);
    }
    out.push(b']');
}

fn spot(line: &mut JsonLine, spot: &Spot) {
    line.text("program", &spot.program).integer("line", spot.line);
}

fn pair(line: &mut JsonLine, name: &str, [low, high]: [f64; 2]) {
    let out = line.field(name);
    out.push(b'[');
    push_number(out, low);
    out.push(b',');
    push_number(out, high);
    out.push(b']');
}

fn axes(line: &mut JsonLine, at: &[(char, f64)]) {
    for (axis, value) in at {
        line.number(&axis.to_ascii_lowercase().to_string(), *value);
    }
}

fn tools(line: &mut JsonLine, tools: &[Option<u32>]) {
    let out = line.field("tools");
    let list: Vec<_> = tools.iter().map(|tool| tool.map_or_else(|| "null".to_owned(), |t| t.to_string())).collect();
    out.extend_from_slice(format!("[{}]", list.join(",")).as_bytes());
}

fn numbers(line: &mut JsonLine, name: &str, numbers: &std::collections::BTreeSet<u32>) {
    let list: Vec<_> = numbers.iter().map(u32::to_string).collect();
    line.field(name).extend_from_slice(format!("[{}]", list.join(",")).as_bytes());
}

fn tool(tool: &ToolSheet, line: &mut JsonLine) {
    match tool.tool {
        Some(number) => {
            line.integer("t", u64::from(number));
        }
        None => line.field("t").extend_from_slice(b"null"),
    }
    spot(line, &tool.first);
    texts(line, "remarks", &tool.remarks);
    numbers(line, "h", &tool.h);
    numbers(line, "d", &tool.d);
    if let Some(range) = tool.speeds {
        pair(line, "s", [range.low, range.high]);
    }
    if let Some(range) = tool.feeds {
        pair(line, "f", [range.low, range.high]);
    }
    line.number("cutting", tool.cutting).number("total", tool.total);
    if let Some(lowest) = &tool.lowest {
        line.object("lowest", |line| {
            line.number("machine", lowest.machine).number("tip", lowest.tip).number("program", lowest.program);
            line.text("system", &lowest.system).integer("line", lowest.spot.line);
        });
    }
    line.object("extents", |line| {
        let mut systems: Vec<&str> = tool.extents.iter().map(|(system, ..)| system.as_str()).collect();
        systems.dedup();
        for system in systems {
            line.object(system, |line| {
                for (_, axis, range) in tool.extents.iter().filter(|(own, ..)| own == system) {
                    pair(line, &axis.to_ascii_lowercase().to_string(), [range.low, range.high]);
                }
            });
        }
    });
    list(line, "operations", &tool.operations, |operation, line| {
        if !operation.code.is_empty() {
            line.text("code", &operation.code).integer("holes", operation.holes);
        }
        line.text("text", &operation.text).number("length", operation.length);
        if let Some(depth) = operation.depth {
            line.number("depth", depth);
        }
        spot(line, &operation.first);
    });
}
