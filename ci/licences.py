#!/usr/bin/env python3
"""Checks that every crate this program is built from has a licence that lets us ship it.

    ci/licences.py            reads `cargo metadata --locked`
    ci/licences.py FILE       reads such output from a file

A licence expression (SPDX) is allowed if it can be satisfied with licences of ALLOWED: one side of an OR, both of an AND.
"""
import json
import re
import subprocess
import sys

ALLOWED = {
    "MIT", "MIT-0", "Apache-2.0", "BSD-2-Clause", "BSD-3-Clause", "BSL-1.0", "ISC", "Zlib", "0BSD", "CC0-1.0",
    "Unlicense", "Unicode-3.0", "Unicode-DFS-2016",
    "MPL-2.0",  # file by file: we change none of its files
    "OFL-1.1", "Bitstream-Vera",  # fonts
}
EXCEPTIONS = {"LLVM-exception"}  # each takes nothing away
# Crates that give no expression, with what their licence file says and who looked.
REVIEWED: dict[str, str] = {}


def allowed(expression: str) -> bool:
    """True if the SPDX expression can be satisfied; `/` is an old way to write OR."""
    tokens = re.findall(r"[()/]|[^\s()/]+", expression)

    def take() -> str:
        return tokens.pop(0) if tokens else ""

    def either() -> bool:
        value = both()
        while tokens and tokens[0] in ("OR", "/"):
            take()
            other = both()
            value = value or other
        return value

    def both() -> bool:
        value = single()
        while tokens and tokens[0] == "AND":
            take()
            other = single()
            value = value and other
        return value

    def single() -> bool:
        token = take()
        if token == "(":
            value = either()
            if take() != ")":
                raise ValueError(f"unbalanced: {expression}")
            return value
        if token in ("", ")", "AND", "OR", "WITH", "/"):
            raise ValueError(f"a licence is missing: {expression}")
        value = token in ALLOWED
        if tokens and tokens[0] == "WITH":
            take()
            value = take() in EXCEPTIONS and value
        return value

    value = either()
    if tokens:
        raise ValueError(f"cannot be read from {tokens[0]!r} on: {expression}")
    return value


def refusals(metadata: dict) -> list[str]:
    """What is wrong with the packages, a sentence each."""
    found = []
    for package in metadata["packages"]:
        if package["source"] is None:
            continue  # our own
        name = f"{package['name']} {package['version']}"
        expression = package["license"] or REVIEWED.get(package["name"])
        if expression is None:
            found.append(f"{name}: states no licence; read its {package['license_file'] or 'sources'} and add it to REVIEWED")
            continue
        try:
            if not allowed(expression):
                found.append(f"{name}: {expression} is not on the list of ci/licences.py")
        except ValueError as error:
            found.append(f"{name}: {error}")
    return sorted(found)


def main() -> int:
    if len(sys.argv) > 1:
        with open(sys.argv[1], encoding="utf-8") as file:
            metadata = json.load(file)
    else:
        command = ["cargo", "metadata", "--format-version", "1", "--locked"]
        metadata = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
    found = refusals(metadata)
    for line in found:
        print(f"licences: {line}", file=sys.stderr)
    if not found:
        print(f"licences: {len(metadata['packages'])} packages, all allowed")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
