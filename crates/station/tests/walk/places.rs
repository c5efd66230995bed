//! Where the walks go: controls of both families, machines with and without builder's logic, and the programs in them.

use std::sync::LazyLock;

use base::SourceId;
use machine::{MachineFile, read_machine};
use station::{Configuration, Setup, read_setup};

use crate::watch::{Texts, load, machine};

/// Programs with all that can hold one up, and (first) one that works whatever came before it.
pub const PROGRAMS: [&str; 14] = [
    "O1\nG21G90\nG53G00X1.Y2.Z3.\nM30\n",
    "O2\nG90G00X5.\nM00\nG01Y5.F500\nG91G81X1.Y1.Z-1.R-1.L3\nM02\n",
    "O3\nG90G00X5.\nX2000.\nG91\nG92X0Y0Z0\nG20\nM30\n",
    "O4\nM98P5L2\nM01\n/G00X1.\nG43Z5.H31\nT1M06\nS500M03\nM30\nO5\nG91G00X1.\nG04P500\nM99\n",
    "O6\nG91G00X1.",
    "O7\nG02X1.\nM30\n",
    "O8\nG41D31\nG01X5.F100\nG28X0\nM30\n",
    "",
    "O9\nM95\n#100=1\nM91P9\nM93\nG91G31X10.F1000\nWHILE[#100LT3]DO1\n#100=#100+1\nG00X#100\nEND1\nX1.\nX1.\nN9M30\n",
    "O10\nG51X0Y0P2000\nG01X1.F500\nG50\nG66P5\nG00Y1.\nG67\nG12I5.D31F300\n#3003=3\n#3004=7\nG76X2.Z-1.R0Q0.5F100\nG80M08\nG04P100\nM30\n",
    "M99P7\nN7M02\nN8G90G00X3.\nM99P8\n",
    "O11\nG91G01X-1.F200T3\nM06\nT7\nM60\nB45.\nM06\nX1.M19\nM30\n",
    "O12\nG90G00X1.Y1.\nS300M03\nG84X2.Y1.Z-3.R-1.F300\nX3.\nG80\nG10P7R1.5\n#510=1.5\nM30\n",
    "O13\nG91G01X30.F600\nY30.\nG02X10.Y10.I10.J0\nG03X-10.Y-10.I-10.J0\nG00Z-40.\nN1G01Z40.F2000\nG00X-30.Y-30.\nM30\n",
];

/// The same for a control whose programs are files.
const FILES: [&str; PROGRAMS.len()] = [
    PROGRAMS[0],
    "G90G00X5.\nM00\nG01Y5.F500\nG91G81X1.Y1.Z-1.R-1.F100\nM02\n",
    "G90G00X5.\nX2000.\nG91\nG92X0Y0Z0\nG20\nM30\n",
    "M98 P4\nM01\n/G00X1.\nG43Z5.H1\nT1M06\nS500M03\nM30\n",
    "G91G00X1.\nG04P500\nM99\n",
    "G02X1.\nM30\n",
    "G41D1\nG01X5.F100\nG28X0\nM30\n",
    "",
    "#100=1\nG91G31X10.F1000\nWHILE[#100LT3]DO1\n#100=#100+1\nG00X#100\nEND1\nX1.\nX1.\nN9M30\n",
    "G51X0Y0P2000\nG01X1.F500\nG50\nG52X5.\nG68X0Y0R30.\nG00Y1.\nG69\nG76X2.Z-1.R0Q0.5F100\nG80\nM08\nG04P100\nM30\n",
    "N7M97P9\nN8G90G00X3.\nM99\nN9X1.\nM99\n",
    "G91G01X-1.F200T3\nM06\nT7\nM60\nB45.\nM06\nX1.\nM19\nM30\n",
    "G90G00X1.Y1.\nS300M03\nG84X2.Y1.Z-3.R-1.F300\nX3.\nG80\n#510=1.5\nM30\n",
    PROGRAMS[13],
];

/// A machine with overtravel switches, dogs, a slow spindle, and moves that are not plain trapezoids.
const WITH_SWITCHES: &str = r#"
name = "with-switches"
description = "three axes with overtravel switches, dogs in front of the reference points and a limited jerk"

[axes.X]
kind = "linear"
travel = [-500.0, 500.0]
jerk = 20000.0
limit_switches = [-505.0, 505.0]
[axes.X.return]
direction = "+"
dog_end = 5.0
dog_length = 30.0
grid = 10.0

[axes.Y]
kind = "linear"
travel = [-400.0, 400.0]
limit_switches = [-405.0, 405.0]

[axes.Z]
kind = "linear"
travel = [-300.0, 300.0]
[axes.Z.return]
direction = "+"
dog_end = 5.0
dog_length = 20.0
grid = 10.0

[path]
model = "jerk"

[spindle]
wait_for_speed = true
acceleration_time = 2.0

[functions]
setup_time = 0.01
strobe_off_time = 0.02
fin_off_time = 0.03

[tape]
speed = 300.0
"#;

/// Control, machine, set-up.
const PLACES: &[(&str, &str, &str)] = &[
    ("yasnac-mx1", "stock-vmc", ""),
    ("incon-m84", "stock-vmc-4", ""),
    ("yasnac-mx1", "tool-changer", ""),
    ("yasnac-mx1", "with-switches", "[policies]\nintervention = \"to-the-end\"\n"),
    ("yasnac-mx1", "pallet-changer", ""),
    ("incon-m86", "tool-changer", ""),
    ("yasnac-mx1", "index-table", ""),
    ("incon-m86r", "stock-table-6", ""),
];

/// How many there are.
pub fn count() -> usize {
    PLACES.len()
}

fn machine_named(name: &str) -> MachineFile {
    if name == "with-switches" { read_machine(name, WITH_SWITCHES).expect("it is valid") } else { machine(name, None) }
}

static CONFIGURATIONS: LazyLock<Vec<Configuration>> = LazyLock::new(|| {
    let one = |(control, machine, setup): &(&str, &str, &str)| {
        let setup = read_setup("setup", setup).expect("it is valid");
        Configuration::new(load(control), machine_named(machine), &[&setup]).expect("the set-up fits")
    };
    PLACES.iter().map(one).collect()
});

/// A control on its machine.
pub fn configuration(place: usize) -> Configuration {
    CONFIGURATIONS[place % PLACES.len()].clone()
}

/// The same, its memory taken up again as it was kept: kind, name, value.
pub fn reopened(place: usize, kept: &[(station::CellKind, String, String)]) -> Configuration {
    let (_, machine, setup) = PLACES[place % PLACES.len()];
    let mut memory = Setup::default();
    kept.iter().for_each(|(kind, name, value)| memory.keep(*kind, name, value));
    let setup = read_setup("setup", setup).expect("it is valid");
    let control = CONFIGURATIONS[place % PLACES.len()].control.clone();
    Configuration::new(control, machine_named(machine), &[&setup, &memory]).expect("what was kept is taken up")
}

/// The programs as files on the shelf.
pub fn texts(place: usize) -> Texts {
    let by_file = CONFIGURATIONS[place % PLACES.len()].control.files.is_some();
    let programs = if by_file { &FILES } else { &PROGRAMS };
    // The shelf knows by its file what M98 calls.
    let files = vec![("P4.CNC", SourceId(4))];
    Texts { texts: programs.iter().map(|text| text.as_bytes().to_vec()).collect(), files, ..Texts::default() }
}
