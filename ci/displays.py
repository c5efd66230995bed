"""docs/displays.md: what every `show` prints. The fields are told here and held against what the program has printed in the
cases: a field that is printed and not told, told and never printed, or of another type is a fault."""
import json
import re
from pathlib import Path

LONGEST = 130  # characters of an example's line
ITEMS = 3  # of a list, before the rest is left out

HEAD = """Everything that a control shows is there as data: `cyclestart operate` prints an event for each `show`, and a program that
embeds the station gets the same values. A page of a screen is drawn from one of them or of several.

```json
{"event":"show","what":"feed","value":{"f":200,"override":100,"actual":200},"time":2.5}
```

`what` repeats what was asked for, `value` is what this page describes, `time` the virtual time since the call began, s. What cannot be
shown is an event `refused` with the reason.

* Lengths are mm, angles degrees, times s, whatever the program's unit of input; feeds are mm a minute (mm a turn where the
  program says so). Macro variables are numbers as the program has them.
* Axes are objects by their letters in lower case, in the machine's order: `{"x":1.5,"y":0,"z":-20}`.
* A field that is marked *if* is left out where there is nothing to say. Where the table says null, null stands there.
* To look changes nothing: nothing is read ahead, no time passes, and what follows is the same to the last bit (a test looks at every display at
  random moments of every program of the corpus).

`operate --realtime --displays 60` prints `position`, `state`, `feed` and `modal` sixty times a second. The others are asked for when a page is
drawn; the lists (`offsets`, `parameters`) are long."""

AXIS = "<axis>"
PLACE = "mm or degrees"
BLOCK = [
    ("program", "text", "the program of the block; `MDI` for what was typed"),
    ("line", "number", "its line in the program's text"),
    ("n", "number, if", "its sequence number N"),
    ("text", "text", "the block as it is written"),
    ("refused", "truth, if", "true if the control will raise an alarm at it; nothing more is told of it then"),
    ("modal", "object, if", "the codes in force after it, as `show modal`"),
    ("modal.<group>", "text, if", "by the group's number"),
    ("f", "number, if", "F in force after it, mm/min or mm/rev"),
    ("s", "number, if", "S, rev/min (or a code)"),
    ("t", "number, if", "T"),
    ("b", "number, if", "B"),
    ("h", "number, if", "H"),
    ("d", "number, if", "D"),
    ("codes", "list, if", "what it sends to the machine"),
    ("codes[]", "text, if", "such a code: `M03`, `S1000`"),
    ("target", "object, if", "where it ends, if it moves axes: coordinates of the work system, as position.work will show them"),
    (f"target.{AXIS}", "number, if", PLACE),
]

# show, case of the example (family/name), which of its events, what it is, fields: path, type, meaning.
SHOWS = [
    ("position", "yasnac-mx1/origin-of-the-universal-display", 2, "Where the axes are, in every system of coordinates. SERVO ERROR is not among them: what "
     "the servos lag behind is not modelled.", [
        ("machine", "object", "in machine coordinates"), (f"machine.{AXIS}", "number", PLACE),
        ("work", "object", "ABSOLUTE: in the work system in force, offsets included"), (f"work.{AXIS}", "number", PLACE),
        ("universal", "object", "UNIVERSAL, the relative display: from where `origin` or a G92 has set it"), (f"universal.{AXIS}", "number", PLACE),
        ("distance_to_go", "object", "INCREMENT: what is left of the move under way"), (f"distance_to_go.{AXIS}", "number", PLACE)]),
    ("modal", "yasnac-mx1/", 0, "The G code in force of every group.", [("<group>", "text", "by the group's number: the code")]),
    ("state", "incon-m8x/logic-time-out", 0, "What the station is doing.", [
        ("mode", "text", "the mode switch, by the names of docs/operating.md"), ("running", "truth", "a program runs and is not stopped"),
        ("held", "truth", "it is held by FEED HOLD"),
        ("waiting_for", "text or null", "what it waits for: `cycle-start`, `feed-override`, a signal after a code"),
        ("alarm", "text or null", "the name of the alarm that stands"), ("program", "text or null", "the program that runs, or is selected"),
        ("line", "number", "the line of the block being executed, 0 if none is")]),
    ("feed", "yasnac-mx1/", 0, "The feed.", [
        ("f", "number", "F in force, mm/min or mm/rev"), ("override", "number", "the feed override switch, %"),
        ("actual", "number", "how fast the tool moves now, mm/min")]),
    ("program", "yasnac-mx1/show-command", 0, "The program page.", [
        ("name", "text or null", "the program that runs, or is selected"), ("line", "number", "the line of the block being executed, 0 if none is"),
        ("f", "number", "F in force, mm/min or mm/rev"), ("s", "number", "S, rev/min (or a code)"), ("t", "number", "T"), ("b", "number", "B"), ("h", "number", "H"),
        ("d", "number", "D"),
        ("interrupt", "text or null", "M90 or M91, null where the control has none"), ("buffering", "text or null", "M92 or M93"), ("mirror", "text or null", "M94 or M95"),
        ("corner", "text or null", "M96 or M97"), ("label_skip", "truth", "the next reading of a tape begins behind an end of block"),
        ("typed", "list", "what was typed in MDI and has not been run"), ("typed[]", "text", "a block of it"),
        ("memory", "list", "the programs in memory"), ("memory[]", "text", "the name of one"),
        ("cursor", "object or null, if", "in mode edit: where the cursor is"), ("cursor.line", "number, if", "its line"), ("cursor.word", "text, if", "the word under it, `;` for the end of a block"),
        ("text", "list, if", "in mode edit: the lines about the cursor"), ("text[]", "text, if", "a line")]),
    ("command", "incon-m8x/show-command", 1, "Command data: the blocks that the control's buffer holds. Nothing is read because somebody looks, so `next` has as many blocks as "
     "the control has read ahead by itself: none behind an M00.", [
        ("present", "object, if", "the block being executed"), *[(f"present.{path}", kind, text) for path, kind, text in BLOCK],
        ("next", "list", "those behind it, in their order"), ("next[]", "object", "as `present`"), *[(f"next[].{path}", kind, text) for path, kind, text in BLOCK]]),
    ("alarm", "yasnac-mx1/show-alarms", 0, "The alarm that stands.", [
        ("[]", "object", "it; the list is empty if none stands"), ("[].name", "text", "the control's name of it"), ("[].number", "number or null", "the control's number of it"),
        ("[].text", "text", "what is wrong, with the values"), ("[].line", "number or null", "the line of the block that it is about")]),
    ("alarms", "yasnac-mx1/show-alarms", -1, "The alarms that have been, the newest first, at most a hundred. RESET and power-off leave them; with `--memory` those of earlier calls "
     "are among them, a power failure too.", [
        ("[]", "object", "an alarm"), ("[].name", "text", "the control's name of it"), ("[].number", "number, if", "the control's number of it"), ("[].text", "text", "what was wrong, with the values"),
        ("[].program", "text, if", "the program of its block"), ("[].line", "number, if", "the line of that block"),
        ("[].time", "number, if", "when: virtual time since the call began, s; of an alarm of this call"),
        ("[].date", "text, if", "when: date and time of day, UTC; of an alarm that the memory has kept")]),
    ("diagnosis", "yasnac-mx1/show-diagnosis", 1, "Every line between control and machine by its name, true for on. A group that the machine does not have is left out.", [
        ("codes", "object", "the lines of M, S, T and B in BCD: `M12` is weight 2 of decade 1; a block's further codes (`M2-11`) while they are out"), ("codes.<name>", "truth", "a bit"),
        ("strobes", "object", "MF SF TF BF"), ("strobes.<name>", "truth", "a strobe"),
        ("decoded", "object, if", "the lines of single M codes: M00R M01R M02R M30R"), ("decoded.<name>", "truth, if", "a line"),
        ("handshake", "object", "the answer to codes"), ("handshake.FIN", "truth", "the machine has done what the strobes ask for"), ("handshake.DEN", "truth", "the motion of the block is done whose codes are out"),
        ("inputs", "object", "EOP RWD skip interrupt"), ("inputs.<name>", "truth", "an input"),
        ("spindle", "object", "the spindle's drive: SAR at its speed, ZSP it stands, ORE it stands at its angle"), ("spindle.<name>", "truth", "a line"),
        ("overtravel", "object, if", "overtravel switches: `OT+X`"), ("overtravel.<name>", "truth, if", "an axis stands on it"),
        ("dogs", "object, if", "the switches of reference point dogs: `DECX`"), ("dogs.<name>", "truth, if", "the axis stands on its dog"),
        ("macro_inputs", "object, if", "UI0 to UI31, which macros read"), ("macro_inputs.<name>", "truth, if", "an input"),
        ("macro_outputs", "object, if", "UO0 to UO31, which macros switch"), ("macro_outputs.<name>", "truth, if", "an output"),
        ("builder_inputs", "object, if", "the inputs that the machine's file names"), ("builder_inputs.<name>", "truth, if", "an input"),
        ("builder_outputs", "object, if", "the outputs of the builder's logic"), ("builder_outputs.<name>", "truth, if", "an output")]),
    ("offsets", "incon-m8x/show-lists", 0, "Every offset.", [
        ("[]", "object", "an offset"), ("[].number", "number", "its number"), ("[].value", "number, if", "mm, where lengths and radii share their numbers"),
        ("[].length", "number, if", "the length (H), mm, where they have columns of their own"), ("[].radius", "number, if", "the radius (D), mm")]),
    ("works", "incon-m8x/show-lists", 1, "Every origin, and what counts now.", [
        ("in_force", "text", "the work system in force"), ("origins", "object", "by the names under which `work` writes them: machine coordinates of the origin"),
        ("origins.<name>", "object", "one of them"), (f"origins.<name>.{AXIS}", "number", PLACE),
        ("local", "object, if", "the local origin (G52), where the control has one"), (f"local.{AXIS}", "number, if", PLACE),
        ("shift", "object, if", "by how much G92 has shifted every system, where it does"), (f"shift.{AXIS}", "number, if", PLACE),
        ("zero", "object", "where program zero lies now in machine coordinates, length offset included"), (f"zero.{AXIS}", "number", PLACE)]),
    ("parameters", "yasnac-mx1/show-parameters", 0, "Every parameter.", [
        ("[]", "object", "a parameter"), ("[].name", "text", "its number or name, as `parameter` writes it"), ("[].kind", "text", "`bits`, `choice`, `length` (mm) or `number`"),
        ("[].value", "number", "its value; of a choice the index of its word"), ("[].written", "text", "its value as `parameter NAME = …` writes it; bits as D7 to D0"),
        ("[].text", "text", "what it does"), ("[].bits", "list, if", "of a parameter of bits, those that mean something"), ("[].bits[]", "object, if", "a bit"),
        ("[].bits[].bit", "number, if", "0 to 7"), ("[].bits[].on", "truth, if", "how it stands"), ("[].bits[].text", "text, if", "what it does")]),
    ("variables", "yasnac-mx1/show-lists", -1, "The macro variables that hold something; a blank one is left out. Refused where the option user-macro is not fitted.", [
        ("level", "number", "the level of macro calls whose local variables are shown, 0 for the main program"),
        ("local", "list", "#1 to #33 of that level"), ("local[]", "object", "a variable"), ("local[].number", "number", "its number"), ("local[].value", "number", "its value"),
        ("common", "list", "the common variables"), ("common[]", "object", "a variable"), ("common[].number", "number", "its number"), ("common[].value", "number", "its value")]),
    ("directory", "yasnac-mx1/show-directory-of-a-small-memory", -1, "The programs in memory.", [
        ("programs", "list", "in the order of their names"), ("programs[]", "object", "a program"), ("programs[].name", "text", "its name"),
        ("programs[].bytes", "number, if", "how long it is; not known of a stream that has not been read to its end"),
        ("programs[].protected", "truth", "it can be neither edited nor replaced"),
        ("used", "object", "what memory holds"), ("used.programs", "number", "so many programs"), ("used.bytes", "number, if", "so many bytes"),
        ("free", "object, if", "what is left, where the control has a limit"), ("free.programs", "number, if", "so many programs; no limit of bytes is known")]),
    ("displays", "yasnac-mx1/show-displays", 0, "The pages that the control has. A `show` that belongs to no page of the control is refused; `state`, `machine`, `feed` and `displays` are "
     "shown by every station.", [
        ("[]", "object", "a page"), ("[].key", "text", "the key that calls it"), ("[].name", "text", "its name"), ("[].shows", "text", "the `show` that prints it, of `position` with the field"),
        ("[].text", "text", "what it is for"), ("[].certainty", "text", "how sure it is that the control has it (the letters of the control's tables)")]),
    ("machine", "yasnac-mx1/", 0, "The machine.", [
        ("name", "text", "its file's name"), ("position", "object", "machine coordinates"), (f"position.{AXIS}", "number", PLACE),
        ("reference", "object", "which axes have been returned to their reference points"), (f"reference.{AXIS}", "truth", "this one has"),
        ("emergency_stop", "truth", "the button is pressed"), ("override", "object", "the override switches"), ("override.feed", "number", "%"), ("override.rapid", "number", "%"),
        ("override.spindle", "number", "%"), ("lines", "object, if", "the builder's lines"), ("lines.<name>", "truth, if", "on")]),
    ("offset", "incon-m8x/operate-columns-of-offsets", 0, "`show offset 31`, `show offset H1`, `show offset D1`: one offset.", [("", "number or null", "mm; null if there is none of this name")]),
    ("work", "yasnac-mx1/", 0, "`show work G54`: one origin by the name under which `work` writes it.", [(AXIS, "number", PLACE)]),
    ("parameter", "incon-m8x/operate-columns-of-offsets", 0, "`show parameter 6005`, `show parameter 6005.2`: a parameter or one bit of it.", [
        ("", "number or null", "its value; null if there is none of this name")]),
    ("variable", "yasnac-mx1/", 0, "`show variable 500`: a macro variable, also a system variable.", [
        ("", "number or null", "its value; null if it is blank, is not there, or could only be told by asking the machine")]),
]
PATTERNS = {AXIS: "[a-z]", "<group>": r"\d\d", "<name>": r"[^.\[\]]+"}
OF_ACTIONS = {"restart", "search", "verify"}  # shown by these actions of docs/operating.md


def kind_of(value: object) -> str:
    if value is None:
        return "null"
    kinds = {bool: "truth", int: "number", float: "number", str: "text", list: "list", dict: "object"}
    return kinds[type(value)]


def flatten(value: object, path: str, seen: dict[str, set[str]]) -> None:
    seen.setdefault(path, set()).add(kind_of(value))
    for key, item in value.items() if isinstance(value, dict) else []:
        flatten(item, f"{path}.{key}" if path else key, seen)
    for item in value if isinstance(value, list) else []:
        flatten(item, f"{path}[]", seen)


def printed(root: Path) -> dict[str, list[tuple[str, dict]]]:
    """Every `show` event of the cases by its first word, with its case."""
    found: dict[str, list[tuple[str, dict]]] = {}
    for trace in sorted((root / "cases").glob("*/*/out.trace")):
        if not (trace.parent / "script.txt").is_file():
            continue
        for line in trace.read_text(encoding="utf-8").splitlines():
            if line.startswith('{"event":"show"'):
                event = json.loads(line)
                case = f"{trace.parent.parent.name}/{trace.parent.name}"
                found.setdefault(event["what"].split()[0], []).append((case, event))
    return found


def faults(shows: dict[str, list[tuple[str, dict]]]) -> list[str]:
    """Where the program prints other fields than are told here."""
    found = [f"show {what} is told nowhere" for what in shows if what not in OF_ACTIONS and what not in {show[0] for show in SHOWS}]
    for what, _, _, _, fields in SHOWS:
        seen: dict[str, set[str]] = {}
        for _, event in shows.get(what, []):
            flatten(event["value"], "", seen)
        # A page says of itself what the table's other rows say.
        seen.pop("", None) if not any(path == "" for path, _, _ in fields) else None
        met = set()
        for path, kinds in sorted(seen.items()):
            rows = [row for row in fields if re.fullmatch(pattern(row[0]), path)]
            met |= {row[0] for row in rows}
            allowed = {kind for row in rows for kind in row[1].removesuffix(", if").split(" or ")}
            if not rows:
                found.append(f"show {what}: {path} is printed and not told")
            elif not kinds <= allowed:
                found.append(f"show {what}: {path} is {', '.join(sorted(kinds))}, not {', '.join(sorted(allowed))}")
        # What only a memory holds is shown by its own test.
        found += [f"show {what}: {path} is told and no case prints it" for path, _, _ in fields if path not in met and path != "[].date"]
    return found


def pattern(path: str) -> str:
    for name, regex in PATTERNS.items():
        path = path.replace(name, f"\0{regex}\0")
    return "".join(part if index % 2 else re.escape(part) for index, part in enumerate(path.split("\0")))


def short(value: object) -> str:
    """JSON on one line; of a long list the first items."""
    if isinstance(value, list):
        items = [short(item) for item in value[:ITEMS]] + (["…"] if len(value) > ITEMS else [])
        return "[" + ",".join(items) + "]"
    if isinstance(value, dict):
        return "{" + ",".join(f"{json.dumps(key)}:{short(item)}" for key, item in value.items()) + "}"
    return json.dumps(value, ensure_ascii=False)


def pretty(value: object, indent: str = "") -> list[str]:
    """JSON on lines that are not too long: numbers and texts of an object one after the other, what has parts on lines of its own."""
    if len(indent) + len(short(value)) <= LONGEST or not isinstance(value, (dict, list)):
        return [short(value)]
    opened, closed = "{}" if isinstance(value, dict) else "[]"
    items = list(value.items()) if isinstance(value, dict) else [(None, item) for item in value[:ITEMS]]
    lines, row = [opened], ""
    for index, (key, item) in enumerate(items):
        own = pretty(item, indent + "  ")
        own[0] = (f"{json.dumps(key)}:" if key is not None else "") + own[0]
        own[-1] += "," if index + 1 < len(items) or isinstance(value, list) and len(value) > ITEMS else ""
        has_parts = isinstance(item, (dict, list))
        if row and (has_parts or len(indent) + len(row) + len(own[0]) > LONGEST):
            lines, row = [*lines, "  " + row], ""
        if has_parts:
            lines += ["  " + line for line in own]
        else:
            row += own[0]
    lines += ["  " + row] if row else []
    if isinstance(value, list) and len(value) > ITEMS:
        lines.append("  …")
    return [*lines, closed]


def page(root: Path, shows: dict[str, list[tuple[str, dict]]], table) -> str:
    lines = ["# What the displays show", "", "Made by `ci/pages.py`; the examples are what the program prints in the cases.", "", HEAD, ""]
    for what, case, nth, text, fields in SHOWS:
        events = [(own, event) for own, event in shows.get(what, []) if own.startswith(case)]
        lines += [f"## {what}", "", text, ""]
        rows = [row for row in fields if not row[0].startswith("next[].")]  # those of `present` once more
        lines += table(["field", "type", "what it is"], [[f"`{path}`" if path else "the value", kind.replace(", if", ", *if*"), about] for path, kind, about in rows])
        if not events:
            continue
        own, event = events[nth]
        lines += [f"`show {event['what']}` in [{own}](../cases/{own}):", "", "```text", *pretty(event["value"]), "```", ""]
    return "\n".join(lines).rstrip() + "\n"
