"""Tests of the checks: each must be able to find what it looks for. Run: python3 -m unittest discover ci"""
import tempfile
import unittest
from pathlib import Path

import house
import licences
import pictures


class Licences(unittest.TestCase):
    def test_expressions(self):
        for expression in [
            "MIT", "MIT OR Apache-2.0", "MIT/Apache-2.0", "GPL-3.0-only OR MIT", "(MIT OR GPL-2.0) AND Unicode-3.0",
            "Apache-2.0 WITH LLVM-exception OR Apache-2.0 OR MIT", "(Apache-2.0 OR MIT) AND BSD-3-Clause",
        ]:
            self.assertTrue(licences.allowed(expression), expression)
        for expression in ["GPL-3.0-only", "MIT AND GPL-3.0-only", "Apache-2.0 WITH Other-exception", "LGPL-2.1 OR GPL-2.0",
                           "(MIT OR Zlib) AND AGPL-3.0"]:
            self.assertFalse(licences.allowed(expression), expression)
        for expression in ["", "MIT OR", "(MIT", "MIT Zlib", "AND"]:
            with self.assertRaises(ValueError, msg=expression):
                licences.allowed(expression)

    def test_packages(self):
        def package(name, licence, source="registry"):
            return {"name": name, "version": "1.0.0", "license": licence, "license_file": None, "source": source}

        metadata = {"packages": [package("good", "MIT"), package("ours", None, None), package("bad", "GPL-3.0-only"),
                                 package("silent", None)]}
        found = licences.refusals(metadata)
        self.assertEqual([line.split(" ")[0] for line in found], ["bad", "silent"])


class Pictures(unittest.TestCase):
    def test_pictures_of_a_page(self):
        page = "![A pocket](compensation/inside.svg) and [a page](radius.md), ![b](c/d.svg)"
        self.assertEqual(pictures.pictures_of(page), ["compensation/inside.svg", "c/d.svg"])


class House(unittest.TestCase):
    def check(self, files, check):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, text in files.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            return check(root)

    def test_order(self):
        def manifest(line, table="dependencies"):
            return f'[package]\nname = "x"\n[{table}]\n{line}\n'

        below = {"crates/base/Cargo.toml": manifest("motion.workspace = true")}
        self.assertEqual(len(self.check(below, house.check_order)), 1)
        above = {"crates/motion/Cargo.toml": manifest("base.workspace = true\nlibm.workspace = true")}
        self.assertEqual(self.check(above, house.check_order), [])
        cases = {"crates/cli/Cargo.toml": manifest("testkit.workspace = true", "dev-dependencies")}
        self.assertEqual(self.check(cases, house.check_order), [])
        self.assertEqual(len(self.check({"crates/cellar/Cargo.toml": manifest("")}, house.check_order)), 1)
        page = "| crate | what |\n| --- | --- |\n| `motion` | x |\n| `base` | x |\n"
        turned = above | {"ARCHITECTURE.md": page, "crates/base/Cargo.toml": manifest("")}
        self.assertEqual(len(self.check(turned, house.check_order)), 1)

    def test_purity(self):
        for line in ["use std::fs;", "let t = Instant::now();", 'println!("x");', "use std::collections::HashMap;"]:
            self.assertEqual(len(self.check({"crates/path/src/lib.rs": line}, house.check_sources)), 1, line)
            self.assertEqual(self.check({"crates/cli/src/main.rs": line}, house.check_sources), [], line)
            for harmless in [f"// {line}", f"#[cfg(test)]\nmod tests {{ {line} }}"]:
                self.assertEqual(self.check({"crates/path/src/lib.rs": harmless}, house.check_sources), [], harmless)
        self.assertEqual(self.check({"crates/path/src/lib.rs": 'let s = "std::fs";'}, house.check_sources), [])

    def test_names_of_controls(self):
        line = 'if name == "yasnac-mx1" {'
        self.assertEqual(len(self.check({"crates/meaning/src/a.rs": line}, house.check_sources)), 1)
        self.assertEqual(self.check({"crates/meaning/src/a.rs": "// as YASNAC does\nlet x = \"//\";"}, house.check_sources), [])
        default = '#[arg(default_value = "yasnac-mx1")]'
        self.assertEqual(self.check({"crates/cli/src/a.rs": default}, house.check_sources), [])
        self.assertEqual(len(self.check({"crates/meaning/src/a.rs": default}, house.check_sources)), 1)

    def test_names_of_new_controls(self):
        files = {"controls/heidi-3/control.toml": "", "crates/meaning/src/a.rs": 'if name.starts_with("heidi") {'}
        self.assertEqual(len(self.check(files, house.check_sources)), 1)

    def test_identity(self):
        decisions = [
            'if control.name == "a" {', "if other != control.family {", "if setting.control.title == title {", "match control().maker {",
            "match self.setting.control.name.as_str() {", 'control.name.starts_with("a")', "control\n    .name\n    .as_str()\n    == other",
            "matches!(self.control().family, _)", "if wanted == self.control().name {", 'configuration.control.title.contains("8")',
        ]
        for line in decisions:
            # In a crate that may say the name, the decision alone is the breach.
            self.assertGreaterEqual(len(self.check({"crates/cli/src/a.rs": line}, house.check_identity)), 1, line)
            self.assertGreaterEqual(len(self.check({"crates/meaning/src/a.rs": line}, house.check_identity)), 2, line)
            self.assertEqual(self.check({"crates/dialect/src/a.rs": line}, house.check_identity), [], line)
            self.assertEqual(self.check({"crates/meaning/src/a.rs": f"#[cfg(test)]\n{line}"}, house.check_identity), [], line)
        for crate, line, breaches in [
            ("meaning", "let name = &self.setting.control.name;", 1), ("warnings", "control.family", 1), ("station", "control.name", 1),
            ("station", 'format!("the {} has no axis", control.title)', 0), ("report", "text(&control.name)", 0),
            ("cli", "cases.join(&control.family)", 0), ("meaning", "control.name_of(code)", 0), ("meaning", "control.g_name(row) == x", 0),
            ("meaning", "// control.name == x", 0), ("meaning", "row.name == control.base", 0), ("meaning", "control.name(row)", 0),
        ]:
            self.assertEqual(len(self.check({f"crates/{crate}/src/a.rs": line}, house.check_identity)), breaches, line)

    def test_unfinished(self):
        for line in ["#[ignore]", '#[ignore = "slow"]', "    todo!()", "unimplemented!(\"later\")"]:
            self.assertEqual(len(self.check({"crates/a/tests/b.rs": line}, house.check_unfinished)), 1, line)
        self.assertEqual(self.check({"crates/a/src/b.rs": "// todo!()"}, house.check_unfinished), [])

    def test_outside(self):
        self.assertEqual(len(self.check({"docs/a.md": "see ../" + "shared/x"}, house.check_outside)), 1)
        self.assertEqual(self.check({"docs/a.md": "a shared memory", "target/a": "../" + "shared"}, house.check_outside), [])

    def test_crowd(self):
        self.assertEqual(len(self.check({"crates/a/src/b.rs": "\n" * 451}, house.crowded)), 1)
        self.assertEqual(self.check({"crates/a/src/b.rs": "\n" * 450}, house.crowded), [])


if __name__ == "__main__":
    unittest.main()
