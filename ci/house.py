#!/usr/bin/env python3
"""Checks the rules of the house that no compiler knows (ARCHITECTURE.md). Prints each breach with its file and line.

    ci/house.py [FOLDER]      the repository's folder, the present one if none is given
"""
import re
import sys
import tomllib
from pathlib import Path

# Where ARCHITECTURE.md has no code map: a crate may use only crates before it.
ORDER = ["base", "tape", "syntax", "data", "dialect", "meaning", "path", "motion", "machine", "memory", "station", "report",
         "plot", "cli", "testkit"]
EDGES = {"cli", "memory", "testkit", "server", "language-server", "python"}  # what may touch the world
CROWD = 450  # lines of a file from which on it is listed
IMPURE = [
    (r"\bstd::(fs|net|process|env|thread)\b", "belongs to the edge of the house"),
    (r"\b(Instant|SystemTime)\b", "time is an argument"),
    (r"\be?print(ln)?!|\bdbg!", "only the edge prints"),
    (r"\brand::|\bHash(Map|Set)\b", "the same input gives the same output, in the same order"),
]
UNFINISHED = [(r"#\[ignore", "a test that is not run is no test"), (r"\b(todo|unimplemented)!", "not built is a diagnostic, not a panic")]
KNOWN = {"yasnac", "incon"}  # names of controls are data; those in controls/ are added
# What says which control is loaded, and who may say it (to people). Nobody but dialect may decide by it.
IDENTITY = r"\bcontrol(?:\(\))?\s*\.\s*(name|family|title|maker|summary)\b(?!\s*\()"
SAYS = {"dialect": {"name", "family", "title", "maker", "summary"}, "station": {"title"}, "report": {"name", "title", "maker", "summary"},
        "cli": {"name", "family", "title", "maker", "summary"}, "testkit": {"name", "family"}}
ASKED = r"\s*(?:\.as_(?:str|ref|bytes)\(\))?"
DECIDES = [
    IDENTITY + ASKED + r"\s*(?:==|!=)",
    IDENTITY + ASKED + r"\s*\.\s*(?:eq|ne|eq_ignore_ascii_case|starts_with|ends_with|contains|strip_prefix|find|split)\b",
    r"(?:==|!=)\s*[&*]*\s*(?:\w+(?:\(\))?\s*\.\s*)*" + IDENTITY,
    r"\bmatch\s+[&*]*\s*(?:\w+(?:\(\))?\s*\.\s*)*" + IDENTITY,
    r"matches!\(\s*[&*]*\s*(?:\w+(?:\(\))?\s*\.\s*)*" + IDENTITY,
]
LITERAL = re.compile(r'r#"(.*?)"#|"((?:\\.|[^"\\])*)"')
SKIPPED = {".git", "target", "run", "corpus", "artifacts", "node_modules", "__pycache__"}
OUTSIDE = "../" + "shared"


def crate_order(root: Path) -> list[str]:
    """The crates in the order in which each may use those before it: ARCHITECTURE.md's table `| `name` | … |`."""
    page = root / "ARCHITECTURE.md"
    if page.is_file():
        rows = re.findall(r"^\|\s*`(?:crates/)?([a-z-]+)/?`\s*\|", page.read_text(encoding="utf-8"), re.MULTILINE)
        crates = [name for name in rows if (root / "crates" / name).is_dir()]
        if crates:
            return crates
    return ORDER


def code_of(text: str) -> list[tuple[int, str]]:
    """Numbered lines of code: without comments, up to the tests at a file's end."""
    lines = []
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip() == "#[cfg(test)]":
            break
        # A `//` inside a string literal is no comment.
        bare = LITERAL.sub(lambda match: "_" * len(match.group(0)), line)
        lines.append((number, line[: bare.index("//")] if "//" in bare else line))
    return lines


def check_order(root: Path) -> list[str]:
    order, found = crate_order(root), []
    for manifest in sorted(root.glob("crates/*/Cargo.toml")):
        crate = manifest.parent.name
        if crate not in order:
            found.append(f"crates/{crate}: stands in no place of the order in ARCHITECTURE.md")
            continue
        content = tomllib.loads(manifest.read_text(encoding="utf-8"))
        for table in ("dependencies", "build-dependencies", "dev-dependencies"):
            for used in content.get(table, {}):
                runs_cases = table == "dev-dependencies" and used == "testkit"
                if used in order and order.index(used) >= order.index(crate) and not runs_cases:
                    found.append(f"crates/{crate}/Cargo.toml: uses {used}, which stands below it")
    return found


def control_names(root: Path) -> re.Pattern:
    """Words by which text could mean one control: the first part of each name in controls/."""
    folders = {path.parent.name.split("-")[0] for path in root.glob("controls/*/control.toml")}
    return re.compile("|".join(sorted(re.escape(name) for name in KNOWN | folders)), re.IGNORECASE)


def check_identity(root: Path) -> list[str]:
    """No crate but dialect knows which control is loaded: few may say its name, none may decide by it."""
    found = []
    for path in sorted(root.glob("crates/*/src/**/*.rs")):
        crate, name = path.relative_to(root).parts[1], path.relative_to(root)
        if crate == "dialect":
            continue
        # The lines of one expression belong together, so the code is looked at as a whole.
        code = "\n".join(line for _, line in code_of(path.read_text(encoding="utf-8")))

        def line_of(at: int) -> int:
            return code.count("\n", 0, at) + 1

        for match in re.finditer(IDENTITY, code):
            if match.group(1) not in SAYS.get(crate, set()):
                found.append(f"{name}:{line_of(match.start())}: asks which control is loaded: {match.group(0)}")
        for rule in DECIDES:
            found += [f"{name}:{line_of(match.start())}: decides by a control's name: {' '.join(match.group(0).split())}"
                      for match in re.finditer(rule, code)]
    return found


def check_sources(root: Path) -> list[str]:
    found, controls = [], control_names(root)
    for path in sorted(root.glob("crates/*/src/**/*.rs")):
        crate, name = path.relative_to(root).parts[1], path.relative_to(root)
        code = code_of(path.read_text(encoding="utf-8"))
        for number, line in code:
            if crate not in EDGES:
                outside = LITERAL.sub('""', line)
                found += [f"{name}:{number}: {why}: {line.strip()}" for rule, why in IMPURE if re.search(rule, outside)]
            is_default = crate == "cli" and ("default_value" in line or "help" in line)
            if any(controls.search(text or raw) for raw, text in LITERAL.findall(line)) and not is_default:
                found.append(f"{name}:{number}: a control's name is data, in controls/: {line.strip()}")
    return found


def check_unfinished(root: Path) -> list[str]:
    found = []
    for folder in ("crates", "fuzz", "benches"):
        for path in sorted((root / folder).rglob("*.rs")):
            if SKIPPED & set(path.relative_to(root).parts):
                continue
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                bare = LITERAL.sub('""', line).split("//")[0]
                found += [f"{path.relative_to(root)}:{number}: {why}" for rule, why in UNFINISHED if re.search(rule, bare)]
    return found


def files_of(root: Path) -> list[Path]:
    return [path for path in sorted(root.rglob("*")) if path.is_file() and not SKIPPED & set(path.relative_to(root).parts)]


def check_outside(root: Path) -> list[str]:
    """Nothing may lean on what lies beside the repository."""
    found = []
    for path in files_of(root):
        for number, line in enumerate(path.read_bytes().splitlines(), 1):
            if OUTSIDE.encode() in line or b"/work/" + OUTSIDE[3:].encode() in line:
                found.append(f"{path.relative_to(root)}:{number}: leans on a folder outside the repository")
    return found


def crowded(root: Path) -> list[str]:
    sources = [path for path in files_of(root) if path.suffix in (".rs", ".py", ".ts")]
    counts = [(len(path.read_bytes().splitlines()), path.relative_to(root)) for path in sources]
    return [f"{name}: {count} lines" for count, name in sorted(counts, reverse=True) if count > CROWD]


def breaches(root: Path) -> list[str]:
    return check_order(root) + check_sources(root) + check_identity(root) + check_unfinished(root) + check_outside(root)


def main() -> int:
    root = Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    for line in crowded(root):
        print(f"house: warning: {line}, more than {CROWD}; does a sentence at its head say why?")
    found = breaches(root)
    for line in found:
        print(f"house: {line}", file=sys.stderr)
    if not found:
        print("house: order, purity, names and ends are in order")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
