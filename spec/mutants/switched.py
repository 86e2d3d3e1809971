"""All mutants in one build, each behind a switch (mutant schemata): cargo-mutants lists them, this writes the sources.

`crate::mutant(17)` is true in a process with MUTANT=17 in its environment. A changed operator becomes
`(if crate::mutant(17) { a - b } else { a + b })`, a changed body begins with `if crate::mutant(18) { return ...; }`, a
deleted arm gets a guard. A process with MUTANT_SEEN=FILE notes in it which mutants it came by.
"""
import bisect, collections, json, re
import tree_sitter, tree_sitter_rust

PARSER = tree_sitter.Parser(tree_sitter.Language(tree_sitter_rust.language()))
SWITCH = '''
/// Written by spec/mutants/switched.py.
#[doc(hidden)]
pub fn mutant(id: u32) -> bool {
    use std::sync::atomic::{AtomicBool, Ordering};
    static ON: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    static SEEN: std::sync::OnceLock<Option<std::path::PathBuf>> = std::sync::OnceLock::new();
    static MET: [AtomicBool; COUNT] = [const { AtomicBool::new(false) }; COUNT];
    if let Some(path) = SEEN.get_or_init(|| std::env::var_os("MUTANT_SEEN").map(Into::into)) {
        if !MET[id as usize].swap(true, Ordering::Relaxed) {
            use std::io::Write;
            let mut file = std::fs::OpenOptions::new().create(true).append(true).open(path).unwrap();
            file.write_all(format!("{id}\\n").as_bytes()).unwrap();
        }
    }
    *ON.get_or_init(|| std::env::var("MUTANT").ok().and_then(|v| v.parse().ok()).unwrap_or(u32::MAX)) == id
}
'''


class Site:
    """A span of the source with what may take its place: (mutant's id, text)."""

    def __init__(self, start, end, kind):
        self.start, self.end, self.kind, self.alternatives, self.inner = start, end, kind, [], []


class Written:
    """A rewritten file: its text, and which mutant each of its lines speaks of."""

    def __init__(self):
        self.parts, self.line, self.of_line = [], 1, {}

    def put(self, text, ids=()):
        for k in range(text.count("\n") + 1):
            for i in ids:
                self.of_line.setdefault(self.line + k, set()).add(i)
        self.parts.append(text)
        self.line += text.count("\n")


def rewrite(text, mutants):
    """The source with all these mutants ((id, as cargo-mutants lists it)); and the ids that no switch can express."""
    data, sites, unfit = text.encode(), {}, []
    offsets = [0]
    for line in text.split("\n"):
        offsets.append(offsets[-1] + len(line.encode()) + 1)
    lines = text.split("\n")

    def at(p):
        return offsets[p["line"] - 1] + len(lines[p["line"] - 1][: p["column"] - 1].encode())

    root = PARSER.parse(data).root_node
    for number, m in mutants:
        start, end = at(m["span"]["start"]), at(m["span"]["end"])
        where = place(root, data, m, start, end)
        if where is None:
            unfit.append(number)
            continue
        s, e, kind, alternative = where
        sites.setdefault((s, e, kind), Site(s, e, kind)).alternatives.append((number, alternative))
    top, stack = [], []
    for site in sorted(sites.values(), key=lambda s: (s.start, -s.end, s.kind != "body")):
        while stack and not (stack[-1].start <= site.start and site.end <= stack[-1].end):
            stack.pop()
        (stack[-1].inner if stack else top).append(site)
        stack.append(site)
    out = Written()
    write(out, data, 0, len(data), top)
    return out, unfit


def place(root, data, m, start, end):
    """(start, end, kind, text instead) of a mutant."""
    text = m["replacement"]
    if m["genre"] == "FnValue":
        return start, end, "body", text
    node = root.descendant_for_byte_range(start, end)
    if m["genre"] in ("BinaryOperator", "UnaryOperator"):
        kinds = ("binary_expression", "compound_assignment_expr", "unary_expression")
        while node is not None and node.type not in kinds:
            if node.type in ("let_chain", "block", "source_file"):
                return None
            node = node.parent
        if node is None:
            return None
        while node.parent is not None and node.type != "compound_assignment_expr" and node.parent.type in ("binary_expression", "unary_expression"):
            node = node.parent
        return node.start_byte, node.end_byte, "expression", spliced(data, node, start, end, text)
    if m["genre"] == "MatchArmGuard":
        return start, end, "expression", text
    if m["genre"] == "MatchArm":
        while node is not None and node.type != "match_arm":
            node = node.parent
        pattern = node.child_by_field_name("pattern")
        guard = pattern.child_by_field_name("condition")
        if guard is None:
            return pattern.end_byte, pattern.end_byte, "guard", ""
        return guard.start_byte, guard.end_byte, "expression", "false"
    if m["genre"] == "StructField":
        while node is not None and node.type != "struct_expression":
            node = node.parent
        return node.start_byte, node.end_byte, "expression", spliced(data, node, start, end, text)
    return None


def spliced(data, node, start, end, text):
    return (data[node.start_byte:start] + text.encode() + data[end:node.end_byte]).decode()


def write(out, data, start, end, sites):
    for site in sites:
        out.put(data[start:site.start].decode())
        start = site.end
        if site.kind == "body":
            for number, text in site.alternatives:
                out.put("\n")
                out.put(f"if crate::mutant({number}) {{ return {text}; }}", [number])
                out.put("\n")
            write(out, data, site.start, site.end, site.inner)
        elif site.kind == "guard":
            numbers = [n for n, _ in site.alternatives]
            out.put("\n")
            out.put(" if " + " && ".join(f"!crate::mutant({n})" for n in numbers), numbers)
            out.put("\n")
        else:
            out.put("(")
            for number, text in site.alternatives:
                out.put("\n")
                out.put(f"if crate::mutant({number}) {{ {text} }} else ", [number])
                out.put("\n")
            out.put("{ ")
            write(out, data, site.start, site.end, site.inner)
            out.put(" })")
    out.put(data[start:end].decode())


UNTYPED = {"E0277", "E0308", "E0369", "E0599", "E0600", "E0614", "E0368", "E0604", "E0605", "E0606", "E0061", "E0560", "E0063", "E0423", "E0425", "E0433"}


def outermost(span):
    """Where a macro was called, with whether the span is the error's own."""
    place = span
    while place.get("expansion"):
        place = place["expansion"]["span"]
    return place | {"is_primary": span["is_primary"]}


def blame(messages, of_line):
    """From cargo's messages: {id: code} of the mutants whose text does not compile, and errors nobody is to blame for."""
    guilty, unknown = {}, []
    for message in messages:
        if message.get("reason") != "compiler-message" or message["message"]["level"] not in ("error", "error: internal compiler error"):
            continue
        message = message["message"]
        code = (message.get("code") or {}).get("code", "")
        spans = [outermost(s) for s in message["spans"] + [s for c in message.get("children", []) for s in c["spans"]]]
        ids = lambda some: {i for s in some for line in range(s["line_start"], s["line_end"] + 1) for i in of_line.get(s["file_name"], {}).get(line, ())}
        narrow = [s for s in spans if s["line_end"] - s["line_start"] < 1]
        found = ids(s for s in narrow if s["is_primary"]) or ids(narrow) or ids(spans)
        if found:
            for i in found:
                guilty[i] = code
        elif spans:
            unknown.append((code, message["message"], [(s["file_name"], s["line_start"], s["line_end"]) for s in spans]))
    return guilty, unknown
