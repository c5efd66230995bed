#!/usr/bin/env python3
"""Makes the programmer's pages docs/CONTROL/*.md from the tables of controls/ and the cases, and docs/operating.md from
the station's table of actions, and docs/displays.md (ci/displays.py) from the cases.

    ci/pages.py            writes them
    ci/pages.py --check    says which would change, and exits with 1 if any would
"""
import json
import re
import sys
import tomllib
from pathlib import Path

import displays

ROOT = Path(__file__).resolve().parent.parent
SHOWN = 40  # lines of a result


class Control:
    """The tables and cases of one control."""

    def __init__(self, name: str) -> None:
        folder = ROOT / "controls" / name
        read = lambda file: tomllib.loads((folder / f"{file}.toml").read_text(encoding="utf-8"))
        self.name, self.head = name, read("control")
        self.g = {f"G{row['g']:02}": row for row in read("g_codes")["code"]}
        self.m = {f"M{row['m']:02}": row for row in read("m_codes")["code"]}
        self.alarms = {row["name"]: row for row in read("alarms")["alarm"]}
        self.options = {f"option {row['name']}": row for row in self.head["option"]}
        self.policies = {row["name"]: row for row in self.head["policy"]}
        self.parameters = {f"parameter {row['name']}": row for row in read("parameters")["parameter"] if "name" in row}
        self.groups = {row["number"]: row for row in self.head["group"]}
        pages = read("pages")
        self.pages, self.marks = pages["page"], pages["certainty"]
        corpus = ROOT / "cases" / name
        rules = tomllib.loads((corpus / "rules.toml").read_text(encoding="utf-8"))
        self.rules = {row["name"]: row["text"] for kind in ("rule", "table", "program") for row in rules.get(kind, [])}
        self.cases = {
            case.parent.name: tomllib.loads(case.read_text(encoding="utf-8")) for case in sorted(corpus.glob("*/case.toml"))
        }


def table(head: list[str], rows: list[list[str]]) -> list[str]:
    if not rows:
        return []
    cell = lambda text: str(text).replace("|", "\\|").replace("\n", " ")
    line = lambda cells: "| " + " | ".join(cell(one) for one in cells) + " |"
    return [line(head), line(["---"] * len(head)), *map(line, rows), ""]


def certainty(control: Control, row: dict) -> str:
    return f"{row['certainty']} ({control.marks[row['certainty']]})"


def codes(control: Control, covers: list[str]) -> list[str]:
    rows = []
    for name in covers:
        if row := control.g.get(name):
            group = row.get("group")
            kind = "one-shot" if row.get("one_shot") else f"modal, group {group:02}"
            state = ""
            if group:
                rule = control.groups[group]
                state = "in force at power-on" if rule["power_on"] == name else ""
                if "power_on_parameter" in rule:
                    parameter = rule["power_on_parameter"]
                    state = "power-on by " + (f"#{parameter['number']}" if "number" in parameter else parameter["name"])
            division = row.get("option") or row.get("division", "basic")
            rows.append([name, row["text"], kind, division, state, certainty(control, row), row["source"]])
        elif row := control.m.get(name):
            out = "goes to the machine" if row["to_machine"] else "inside the control"
            rows.append([name, row["text"], out, "", "", certainty(control, row), row["source"]])
    return table(["code", "what it does", "kind", "belongs to", "state", "certainty", "source"], rows)


def silent(control: Control, covers: list[str]) -> list[str]:
    rows, seen = [], set()
    for name in covers:
        policy = name.removeprefix("policy ").split("=")[0]
        if name.startswith("policy ") and policy not in seen:
            seen.add(policy)
            row = control.policies[policy]
            values = ", ".join(f"**{value}**" if value == row["default"] else value for value in row["values"])
            rows.append([f"`{policy}`", values, row["text"], certainty(control, row)])
    return table(["policy", "values (default bold)", "where the maker's text is silent", "certainty"], rows)


def short(event: dict) -> str:
    """An event of the trace in a few words."""
    kind, parts = event["event"], []
    if "to" in event:
        parts.append(" ".join(f"{axis.upper()}{value:g}" for axis, value in event["to"].items()))
    for key, text in (("f", "F{:g}"), ("sweep", "sweep {:g} deg"), ("seconds", "{:g} s"), ("revolutions", "{:g} turns")):
        if key in event:
            parts.append(text.format(event[key]))
    for key in ("code", "kind", "what", "value", "name", "text"):
        if key in event:
            value = event[key]
            parts.append(value if isinstance(value, str) else json.dumps(value))
    return f"line {event['line']}: {kind} {', '.join(parts)}" if "line" in event else f"{kind} {', '.join(parts)}"


def example(control: Control, name: str) -> list[str]:
    folder = ROOT / "cases" / control.name / name
    case = control.cases[name]
    program = next((folder / file for file in ("in.nc", "a.nc") if (folder / file).is_file()), None)
    lines = ["## Example", "", f"{case['why'][0].upper()}{case['why'][1:].rstrip('.')}.", ""]
    said = ["--control", case["control"]] if "control" in case else []
    quoted = lambda word: f'"{word}"' if " " in word else word
    if arguments := said + [quoted(word) for word in case.get("arguments", [])]:
        lines += ["Set up with `" + " ".join(arguments) + "`.", ""]
    if program:
        lines += ["```text", program.read_text(encoding="latin-1").replace("\r", "").rstrip(), "```", ""]
    out = folder / "out.trace"
    if out.is_file() and case.get("run", "trace").startswith(("trace", "operate")):
        events = [json.loads(line) for line in out.read_text(encoding="utf-8").splitlines()]
        told = [short(event) for event in events if event["event"] not in ("start", "reset")]
        more = [f"… and {len(told) - SHOWN} more"] if len(told) > SHOWN else []
        lines += ["What the control does (machine coordinates):", "", "```text", *told[:SHOWN], *more, "```", ""]
    return lines


def by_control(controls: list[Control], page: dict, own: Control) -> list[str]:
    """The same meaning on every control."""
    rows = []
    for name in page["covers"]:
        if not (row := own.g.get(name)):
            continue
        cells = []
        for control in controls:
            same = [code for code, other in control.g.items() if other["meaning"] == row["meaning"]]
            same = [code for code in same if control.g[code].get("division") != "sibling"] if len(same) > 1 else same
            cells.append(", ".join(same) or "none")
        rows.append([row["meaning"], *cells])
    return table(["meaning", *(control.head["title"] for control in controls)], rows)


def page_text(controls: list[Control], control: Control, page: dict) -> str:
    covers = page["covers"]
    lines = [f"# {page['title']}", "", f"{control.head['title']}. Made by `ci/pages.py` from the control's tables and cases.", ""]
    if page["form"]:
        lines += ["```text", *page["form"], "```", ""]
    lines += [page["text"], ""]
    lines += table(["word", "says"], [word.split(": ", 1) for word in page["words"]])
    if found := codes(control, covers):
        lines += ["## Codes", "", *found]
    if page["example"] in control.cases:
        lines += example(control, page["example"])
    rules = [[name, control.rules[name]] for name in covers if name in control.rules]
    if rules:
        lines += ["## Rules", "", *table(["rule", "says"], rules)]
    options = [[name.removeprefix("option "), row["text"], "yes" if row["default"] else "no", certainty(control, row)]
               for name in covers if (row := control.options.get(name))]
    if options:
        lines += ["## Options", "", *table(["option", "what it is", "fitted as it comes", "certainty"], options)]
    parameters = [[name.removeprefix("parameter "), ", ".join(row.get("values", [])) or row.get("default", 0), row["text"],
                   certainty(control, row)] for name in covers if (row := control.parameters.get(name))]
    if parameters:
        lines += ["## Parameters", "", *table(["parameter", "values, or value as it comes", "what it does", "certainty"], parameters)]
    if found := silent(control, covers):
        lines += ["## Where the manual is silent", "", *found]
    alarms = [[name, row.get("number", ""), row["text"], certainty(control, row)]
              for name in covers if (row := control.alarms.get(name))]
    if alarms:
        lines += ["## Alarms", "", *table(["alarm", "number", "text", "certainty"], alarms)]
    if found := by_control(controls, page, control):
        lines += ["## By control", "", *found]
    cases = [[f"[{name}](../../cases/{control.name}/{name})", case["why"], case["certainty"]]
             for name, case in control.cases.items()
             if "waits" not in case and set(case["covers"]) & set(covers)]
    waiting = [name for name, case in control.cases.items() if "waits" in case and set(case["covers"]) & set(covers)]
    lines += ["## Cases", "", "Each is a test: its folder holds the program and exactly what the control does.", ""]
    lines += table(["case", "what it shows", "certainty"], cases)
    if waiting:
        lines += ["Not built yet: " + ", ".join(waiting) + ".", ""]
    return "\n".join(lines).rstrip() + "\n"


def index(control: Control) -> str:
    lines = [f"# {control.head['title']}: the programmer's pages", "", control.head["summary"][0].upper() + control.head["summary"][1:] + ".", "",
             "Every page is made from the control's tables and cases by `ci/pages.py`.", ""]
    coded = lambda page: ", ".join(name for name in page["covers"] if name in control.g or name in control.m)
    lines += table(["page", "codes"], [[f"[{page['title']}]({page['name']}.md)", coded(page)] for page in control.pages])
    return "\n".join(lines).rstrip() + "\n"


STATES = ["power off", "emergency stop", "alarm", "automatic mode, nothing runs", "manual mode, nothing moves", "axis moved by hand",
          "program runs", "program waits for the machine (FIN)", "held (FEED HOLD)", "stopped (M00, M01, SINGLE BLOCK)"]
ACTIONS = {
    "PowerOn": "`power-on`", "PowerOff": "`power-off`", "Load": "`load`", "Select": "`select`", "Mode": "`mode`", "Type": "`mdi`",
    "CycleStart": "`cycle-start`", "FeedHold": "`feed-hold`", "Reset": "`reset`", "Key": "`key` (then as what the key does)",
    "EmergencyStop": "`emergency-stop`", "Release": "`release`", "Turn": "`switch`, `override`, `input`", "Offset": "`offset`, `work`",
    "Touch": "`touch`", "Origin": "`origin`", "Parameter": "`parameter`", "Variable": "`variable`", "Fault": "`fault`", "Show": "`show`", "Run": "`run`", "Jog": "`jog`", "Step": "`step`", "Home": "`home`", "Restart": "`restart`", "Search": "`search`", "Edit": "`edit`", "Tape": "`tape`, `verify`",
}
OPERATING = """The control is always in one of the ten states below. An action that it takes there is marked *yes*; any other is refused, changes
nothing, and the letter says why. `cyclestart operate` answers from the same table.

Axes are moved by hand in the manual modes, each button in its own:

* `jog X +` in mode jog moves at the jog speed, in mode rapid at the rapid rate. With `for 2` the button is pressed for two seconds, and
  the axis then comes to stand. Without it the button stays pressed while `run` lets time pass, until FEED HOLD or RESET.
* `step X + 0.01` moves by one increment in mode step (the control's are named with its modes below), in mode handle by as much as the
  handle is turned.
* `home X` in mode return drives to the reference point at the rapid rate while `run` lets time pass; arrived, the axis is returned.

FEED HOLD, RESET and EMERGENCY STOP stop the axis as fast as it can; what is left of its way is dropped. At the border of its travel it
stands and the alarm says so; RESET, then move back. With MACHINE LOCK (and Z-AXIS CANCEL for Z) the displays count and the axis stands;
with DISPLAY LOCK it moves and they stand. With MANUAL ABSOLUTE on, what was moved by hand counts into the program's coordinates; off, the
program runs beside its place by as much, until the axis is returned to its reference point, EMERGENCY STOP, or power-on.

**In the middle of a program**, held or stopped, `jog` and `step` move the axes too (choose a manual mode, afterwards the program's again;
CYCLE START goes on). Moved back to where it was held, the program goes on as if nothing had been. Moved elsewhere and counted, the way that
was left is made from there, and the next straight move that names the axis' place leads back to it; policy `intervention=to-the-end` lets the
rest of a straight move already lead to its end. An arc is made beside its place.

**Touching off.** `touch H1` writes the position of Z into the offset page as the length of tool 1, `touch H1 at 50` over a gauge of 50 mm
(`touch 31` where lengths and radii share their numbers). Policy `touch-off` says which position: on the relative display, in the work
system in force, or on the machine. For the relative one, bring the standard tool to the place and set Z of the relative display to zero there:
`origin Z`.

**The relative display** (UNIVERSAL) counts from where the operator says, as the key ORG does: `origin X` makes it show zero where the axis
stands, `origin Z = 100` this number, `origin all` zero on every axis. Nothing moves and no coordinates change. It is taken whenever the
power is on, also while axes move; it stays until the next `origin`, a G92 that presets this display, or power-on.

**Displays.** What each `show` prints, field by field: [displays.md](displays.md). `show displays` lists the pages that the control has.

By itself `operate` lets time pass only with `run`, and as fast as it can. With `--realtime` time passes by the clock, a servo period
at a time. `cyclestart operate - --realtime` is a panel: each line on standard input acts when it comes, `--displays 60` prints position,
state, feed and modal codes 60 times a second. A line that is no action, or names a file that cannot be read, is refused and changes
nothing. `emergency-stop` does not wait for a `run` before it; what stands between the two is refused. At its end the command says how
late its periods came. A computer that stops for more than half a second does not make up for it."""


PROGRAMS = """## Programs

**Search.** `search N50` puts the pointer on the block with that number in the selected program: the next one behind the pointer, then from
the head. `search O1234` selects a program. Nothing is executed, and codes, offsets and places are as they stand: CYCLE START begins there
as if the blocks before it were not in the program.

**Restart in mid-program.** `restart N50`, `restart line 12`, `restart O20 N5 pass 3` (a block that is executed several times wants the pass)
runs the selected program from its head to the block, without moving anything, and shows what it would be like there: codes in force,
F S T B H D, the place where the block before ends, the axes' way there (`approach`), the codes that the machine still wants (`give`), and what
cannot be restored (`not_restored`). Those codes are given by MDI; `restart confirm` takes the rest as shown, and CYCLE START begins. The axes
go to the place one after the other at the jog speed, Z off the work first and down last (policy `restart-approach`), FEED HOLD stops them, and the
program runs on as if it had never stopped: in the middle of compensation, cycles, subprograms and loops. What the program writes on the way
(offsets, kept variables) is written once more, and named. It is refused if the program does not come to the block, raises an alarm before it,
or if a lock switch is on. In mode tape it takes up the tape, which the reader reads from its head. What was confirmed no longer counts if anything has changed that it depends on. RESET drops it.

**Edit.** In mode edit a cursor stands on a word of the selected program; `show program` shows both. `edit top`, `edit next`, `edit back`,
`edit line 12`, `edit find X10.` and `edit find X` (any X) move it. `edit insert G04 P500;` puts words in behind it (`;` ends a block),
`edit alter X12.` puts them in its place, `edit delete` and `edit delete block` erase, `edit new O1234` and `edit delete program O1234` make and delete
programs. With `switch edit-lock on` nothing in memory is changed; a protected program raises its alarm. The program then stands at its head.

**Tape.** `tape FILE` puts a tape into the reader. In mode tape CYCLE START runs it, whatever is selected in memory; without one, the file from which
the selected program was loaded. `[tape] speed` in the machine file is the reader's, in characters a second: a block that has not been read in time
is waited for. `verify` (modes edit and tape) compares the tape with the programs in memory and names the first block that differs."""


def operating(controls: list[Control]) -> str:
    """The page of the station's table, from the table itself."""
    code = (ROOT / "crates" / "station" / "src" / "operator" / "table.rs").read_text(encoding="utf-8")
    whys = dict(re.findall(r'^const (\w+): Answer = Some\("(.*?)"\);', code, re.MULTILINE))
    rows = re.findall(r"\(Kind::(\w+),\s*\[([\w, ]+)\]\)", code)
    letters = {why: chr(ord("a") + index) for index, why in enumerate(whys)}
    cell = lambda answer: "yes" if answer == "GO" else letters[answer]
    lines = ["# What the control takes when", "", "Made by `ci/pages.py` from the station's table.", "", OPERATING, ""]
    lines += table(["action", *STATES], [[ACTIONS[kind], *map(cell, answers.replace(",", " ").split())] for kind, answers in rows])
    lines += [f"* {letter}: {whys[why]}" for why, letter in letters.items()] + [""]
    lines += [PROGRAMS, ""]
    for control in controls:
        station = tomllib.loads((ROOT / "controls" / control.name / "station.toml").read_text(encoding="utf-8"))
        lines += [f"## Modes of {control.head['title']}", ""]
        lines += table(["mode", "what it is for", "certainty"],
                       [[f"`{row['name']}`", row["text"], certainty(control, row)] for row in station["mode"]])
        lines += [f"Switches of {control.head['title']}:", ""]
        lines += table(["switch", "what it does", "certainty"],
                       [[f"`{row['name']}`", row["text"], certainty(control, row)] for row in station["switch"]])
        if steps := station.get("by_hand", {}).get("increments"):
            lines += [f"Increments of mode step: {', '.join(map(str, steps))} mm or degrees.", ""]
    return "\n".join(lines).rstrip() + "\n"


def main() -> int:
    check = "--check" in sys.argv[1:]
    folders = sorted(path.parent for path in ROOT.glob("controls/*/pages.toml"))
    controls = [Control(folder.name) for folder in folders]
    faults = []
    for control in controls:
        missing = [code for code, row in {**control.g, **control.m}.items()
                   if row.get("division") != "sibling" and not any(code in page["covers"] for page in control.pages)]
        faults += [f"{control.name}: {code} stands on no page" for code in missing]
        faults += [f"{control.name}: the page {page['name']} has no example"
                   for page in control.pages if page["form"] and page["example"] not in control.cases]
        wanted = {f"{page['name']}.md": page_text(controls, control, page) for page in control.pages}
        wanted["README.md"] = index(control)
        folder = ROOT / "docs" / control.name
        folder.mkdir(parents=True, exist_ok=True)
        old = {path.name: path.read_text(encoding="utf-8") for path in folder.glob("*.md")}
        for name in sorted(old.keys() | wanted.keys()):
            if old.get(name) == wanted.get(name):
                continue
            if check:
                faults.append(f"docs/{control.name}/{name} is not what the tables say: run ci/pages.py")
            elif name in wanted:
                (folder / name).write_text(wanted[name], encoding="utf-8")
            else:
                (folder / name).unlink()
    shows = displays.printed(ROOT)
    faults += displays.faults(shows)
    for name, text in (("operating", operating(controls)), ("displays", displays.page(ROOT, shows, table))):
        page = ROOT / "docs" / f"{name}.md"
        if page.is_file() and page.read_text(encoding="utf-8") == text:
            continue
        if check:
            faults.append(f"docs/{name}.md is not what the tables and cases say: run ci/pages.py")
        else:
            page.write_text(text, encoding="utf-8")
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
