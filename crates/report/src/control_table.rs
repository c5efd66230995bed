//! A control's tables for people.

use std::fmt::Write as _;

use dialect::{Control, Division, Fate, GCode, Group, GroupRule, StateItem};

/// One line a control.
pub fn control_list<'c>(controls: impl Iterator<Item = &'c Control>) -> String {
    let mut out = String::new();
    for control in controls {
        let _ = writeln!(out, "{:<14} {} ({}): {}", control.name, control.title, control.maker, control.summary);
    }
    out
}

/// Everything that the tables say of a control.
pub fn control_table(control: &Control) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{} ({})\n{}\n", control.title, control.maker, control.summary);
    g_codes(control, &mut out);
    groups(control, &mut out);
    states(control, &mut out);
    modes(control, &mut out);
    displays(control, &mut out);
    m_codes(control, &mut out);
    addresses(control, &mut out);
    options_and_policies(control, &mut out);
    parameters(control, &mut out);
    alarms(control, &mut out);
    out
}

fn heading(out: &mut String, text: &str) {
    let _ = writeln!(out, "{text}\n{}", "─".repeat(text.chars().count()));
}

fn g_codes(control: &Control, out: &mut String) {
    heading(out, "G codes   (* = one-shot; · = in force at power-on; last columns: certainty, meaning)");
    let mut rows: Vec<(usize, &GCode)> = control.g_codes.iter().enumerate().collect();
    rows.sort_by_key(|(_, code)| code.code);
    for (row, code) in rows {
        let group = match code.group.and_then(|group| control.groups.get(usize::from(group))) {
            Some(group) => format!("{:02}", group.number),
            None if code.division == Division::Sibling => "--".to_owned(),
            None => " *".to_owned(),
        };
        let stands = control.groups.iter().any(|group| group.power_on.row == Some(row as u8));
        let division = match code.division {
            Division::Basic => "basic".to_owned(),
            Division::Option(index) => {
                let name = control.options.get(usize::from(index)).map_or("?", |row| row.name.as_str());
                format!("option {name}")
            }
            Division::Sibling => "not on this control".to_owned(),
        };
        let mark = if stands { "·" } else { " " };
        let name = format!("G{:02}", code.code);
        let _ = writeln!(out, "{name:<5}{mark} {group}  {division:<28} {}  {}", code.origin.certainty.0, code.text);
        let _ = writeln!(out, "{:43}{}", "", code.origin.source);
    }
    out.push('\n');
}

fn state(control: &Control, rule: &GroupRule, keeps: &str) -> String {
    let name = |row: Option<u8>| row.map_or_else(|| keeps.to_owned(), |row| control.g_name(row));
    match &rule.parameter {
        None => name(rule.row),
        Some((parameter, bits, rows)) => {
            let parameter = control.parameters.get(*parameter).map_or("?", |row| row.name.as_str());
            let bits: Vec<_> = bits.iter().rev().map(|bit| format!("D{bit}")).collect();
            let names: Vec<_> = rows.iter().map(|&row| name(row)).collect();
            format!("{} by #{parameter} {}", names.join(" / "), bits.join(" "))
        }
    }
}

fn groups(control: &Control, out: &mut String) {
    heading(
        out,
        "Modal groups   (at power-on, after RESET; where they differ also after emergency stop and program end)",
    );
    for Group { number, name, power_on, reset, emergency_stop, program_end, origin, .. } in &control.groups {
        let (at, after) = (state(control, power_on, "-"), state(control, reset, "kept"));
        let _ = write!(out, "{number:02}  {name:<22} {at:<40} {after:<28} {}", origin.certainty.0);
        for (rule, occasion) in [(emergency_stop, "emergency stop"), (program_end, "program end")] {
            if rule != reset {
                let _ = write!(out, "  {occasion}: {}", state(control, rule, "kept"));
            }
        }
        out.push('\n');
    }
    out.push('\n');
}

fn states(control: &Control, out: &mut String) {
    heading(out, "Other states   (at power-on, RESET, emergency stop, program end with reset)");
    for row in &control.station.states {
        let name = StateItem::TABLE.iter().find(|(_, item)| *item == row.item).map_or("?", |(name, _)| name);
        let after = row.fates.map(|fate| if fate == Fate::Keep { "kept" } else { row.initial.as_str() });
        let _ = write!(out, "{name:<20} {}  {}", row.origin.certainty.0, after.join(" / "));
        if let Some(option) = &row.kept_by {
            let _ = write!(out, "; kept through an emergency stop by option {option}");
        }
        out.push('\n');
    }
    out.push('\n');
}

fn modes(control: &Control, out: &mut String) {
    heading(out, "Modes of the operator's station");
    for mode in &control.station.modes {
        let _ = writeln!(out, "{:<10} {}  {}", mode.name, mode.origin.certainty.0, mode.text);
    }
    out.push('\n');
    heading(out, "Switches of the operator's panel   (--switch NAME)");
    for switch in &control.station.switches {
        let _ = writeln!(out, "{:<16} {}  {}", switch.name, switch.origin.certainty.0, switch.text);
    }
    out.push('\n');
}

fn displays(control: &Control, out: &mut String) {
    heading(out, "Pages of the displays   (key, page, what `show` prints of it)");
    for row in &control.station.displays {
        let _ = writeln!(
            out,
            "{:<10} {:<18} {:<24} {}  {}",
            row.key, row.name, row.shows, row.origin.certainty.0, row.text
        );
    }
    out.push('\n');
}

fn m_codes(control: &Control, out: &mut String) {
    heading(out, "M codes of the control   (all others are the machine builder's)");
    for code in &control.m_codes {
        let decoded = code.decoded.as_deref().unwrap_or("");
        let _ = writeln!(out, "M{:02}  {decoded:<6} {}  {}", code.code, code.origin.certainty.0, code.text);
    }
    out.push('\n');
}

fn addresses(control: &Control, out: &mut String) {
    heading(out, "Addresses");
    for address in control.addresses.iter().flatten() {
        let _ = writeln!(out, "{}  {}  {}", char::from(address.letter), address.origin.certainty.0, address.text);
    }
    out.push('\n');
}

fn options_and_policies(control: &Control, out: &mut String) {
    heading(out, "Options   (--option NAME=on|off)");
    for option in &control.options {
        let fitted = if option.default { "on " } else { "off" };
        let _ = writeln!(out, "{:<24} {fitted}  {}  {}", option.name, option.origin.certainty.0, option.text);
    }
    out.push('\n');
    heading(
        out,
        "Policies, where the maker's text is silent   (--policy NAME=VALUE; the first in brackets is the default)",
    );
    for policy in &control.policies {
        let default = policy.values.get(policy.default).map_or("", String::as_str);
        let others: Vec<_> = policy.values.iter().filter(|value| *value != default).map(String::as_str).collect();
        let _ = writeln!(
            out,
            "{:<28} [{default}] {}  {}\n{:31}{}\n{:31}{}",
            policy.name,
            others.join(" "),
            policy.origin.certainty.0,
            "",
            policy.text,
            "",
            policy.origin.source
        );
    }
    out.push('\n');
}

fn parameters(control: &Control, out: &mut String) {
    heading(out, "Parameters   (--parameter NAME=VALUE)");
    for parameter in &control.parameters {
        let _ = writeln!(
            out,
            "{:<24} {:<6} {}  {}",
            parameter.name, parameter.default, parameter.origin.certainty.0, parameter.text
        );
        for bit in &parameter.bits {
            let _ = writeln!(out, "{:20} D{}           {}  {}", "", bit.bit, bit.origin.certainty.0, bit.text);
        }
    }
    out.push('\n');
}

fn alarms(control: &Control, out: &mut String) {
    heading(out, "Alarms");
    for alarm in &control.alarms {
        let number = alarm.number.map_or_else(|| "   ".to_owned(), |number| format!("{number:03}"));
        let _ = writeln!(out, "{:<18} {number}  {}  {}", alarm.name, alarm.origin.certainty.0, alarm.text);
    }
}
