"""Reads `cargo metadata` from stdin; fails if a package is under none of the licences below.

An expression is a conjunction (AND) of choices (OR, or / in old manifests): of each choice one
licence has to be in the list. All of them allow use and copying of the program with a notice.
"""

import json
import sys

ALLOWED = {
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "MIT",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
}


def is_allowed(expression):
    """Has every conjunct an allowed choice?"""
    plain = expression.replace("(", "").replace(")", "").replace("/", " OR ")
    conjuncts = plain.split(" AND ")
    return all(ALLOWED & set(conjunct.split(" OR ")) for conjunct in conjuncts)


assert is_allowed("(MIT OR GPL-3.0) AND Unicode-3.0") and is_allowed("Unlicense/MIT")
assert not is_allowed("GPL-3.0-only") and not is_allowed("MIT AND GPL-3.0-only") and not is_allowed("")

packages = json.load(sys.stdin)["packages"]
refused = [p for p in packages if not is_allowed(p["license"] or "")]
for package in refused:
    print(f"{package['name']} {package['version']}: {package['license']}")

print(f"{len(packages)} packages, {len(refused)} under another licence")
sys.exit(1 if refused or len(packages) < 20 else 0)
