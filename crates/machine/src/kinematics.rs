//! `[kinematics]` of the machine builder's file: which axes tilt and turn the tool or the work, and about which points.

use data::Table;
use meaning::{Carrier, Kinematics};

use crate::file::MachineAxis;

pub(crate) fn kinematics(table: &mut Table, axes: &[MachineAxis]) -> Option<Kinematics> {
    table.require("model");
    table.require("tilt");
    let places = ["tilt", "turn"].map(|key| table.place_of(key).unwrap_or_else(|| table.range()));
    let carriers = [("head", Carrier::Head), ("table", Carrier::Table), ("head-and-table", Carrier::HeadAndTable)];
    let carrier = table.choice("model", &carriers);
    let tilt = table.choice("tilt", &[("A", b'A'), ("B", b'B')]);
    let turn = table.choice("turn", &[("C", b'C')]).unwrap_or(b'C');
    let pivot = table.number("pivot").unwrap_or(0.0);
    let centre_place = table.place_of("centre");
    let centre = match table.numbers("centre").as_deref() {
        None => [0.0; 3],
        Some(&[x, y, z]) => [x, y, z],
        Some(_) => {
            table.error(centre_place.unwrap_or_default(), "centre is a list of three numbers: X, Y and Z");
            [0.0; 3]
        }
    };
    let (carrier, tilt) = (carrier?, tilt?);
    let found = |letter: u8, rotary: bool, place: std::ops::Range<usize>| {
        let index = axes.iter().position(|axis| axis.letter == letter && axis.rotary == rotary);
        if index.is_none() {
            let (kind, letter) = (if rotary { "rotary" } else { "linear" }, char::from(letter));
            table.error(place, format!("the machine has no {kind} axis {letter}"));
        }
        index.map(|index| index as u8)
    };
    let [tilt_place, turn_place] = places;
    let about_y = tilt == b'B';
    let [tilt, turn] = [found(tilt, true, tilt_place), found(turn, true, turn_place.clone())];
    let linear = [b'X', b'Y', b'Z'].map(|letter| found(letter, false, turn_place.clone()));
    let ([Some(x), Some(y), Some(z)], Some(tilt), Some(turn)) = (linear, tilt, turn) else { return None };
    Some(Kinematics { carrier, linear: [x, y, z], tilt, about_y, turn, pivot, centre })
}
