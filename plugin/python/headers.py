"""What the C++ headers declare in public, and what their comments say of it.

    python3 headers.py --docstrings FILE.cpp HEADER...   a table of docstrings for the module
    python3 headers.py HEADER...                         the list of names

The headers are the one place where a name is explained: Python's docstrings are their comments.
"""

import argparse
import re
import sys
import textwrap
from collections import namedtuple
from pathlib import Path

# kind: class, function, field, enum, value, constant. name: with its classes, as in `Gains::K`. doc: lines of comment.
Declaration = namedtuple("Declaration", "name kind doc header")


def without_hidden_parts(text):
    text = re.sub(r"/// @cond.*?/// @endcond", "", text, flags=re.S)
    text = re.sub(r"\\\n", " ", text)
    return re.sub(r"^[ \t]*#.*$", "", text, flags=re.M)


TOKEN = re.compile(r'//[^\n]*|"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])+\'|\n|[^\n]', re.S)


def tokens(text):
    """Comments, strings and single characters, each with its line."""
    line = 1
    for match in TOKEN.finditer(text):
        token = match.group()
        yield token, line
        line += token.count("\n")


def comment_text(comment):
    return re.sub(r"^//+<? ?", "", comment)


def declared(statement):
    """Kind and names of a declaration in a namespace or a class."""
    statement = re.sub(r"\[\[.*?\]\]|\bSEAM_API\b", " ", statement).strip()
    statement = re.sub(r"^template\s*<[^>]*>\s*", "", statement)
    if not statement or re.match(r"(using|friend|static_assert|extern|namespace)\b", statement):
        return None, []
    kind = re.match(r"(class|struct|enum(?:\s+class)?)\s+(\w+)", statement)
    if kind:
        return ("enum" if kind.group(1).startswith("enum") else "class"), [kind.group(2)]
    head = re.split(r"(?<![=<>!])=(?!=)", re.sub(r"<[^<>]*(<[^<>]*>)?[^<>]*>", "", statement), maxsplit=1)[0]
    if "(" in head or re.search(r"\boperator\b", statement):
        function = re.search(r"(operator\s*(?:\(\)|[^\s(\w]+|\w+)|~?\w+)\s*\(", statement)
        return "function", [function.group(1)] if function else []
    if not re.search(r"\s", head):
        return None, []
    head = re.sub(r"\{.*?\}", "", head, flags=re.S)
    names = [re.search(r"(\w+)\s*(\[\w*\])?\s*$", part) for part in head.split(",")]
    return "field", [name.group(1) for name in names if name]


class Scope:
    def __init__(self, kind, name, public):
        self.kind, self.name, self.public = kind, name, public


class Reader:
    """Goes through one header."""

    def __init__(self, path):
        self.header = Path(path).name
        self.found = []
        self.scopes = [Scope("namespace", "", True)]
        self.comments, self.statement, self.begun = [], "", 0
        self.last, self.last_line, self.last_comment_line = [], 0, 0
        self.parens = 0
        self.skipping = 0  # braces that are open in what is not looked at
        self.in_initialiser = False
        for token, line in tokens(without_hidden_parts(Path(path).read_text())):
            self.take(token, line)

    def public(self):
        return all(scope.public for scope in self.scopes)

    def full(self, name):
        return "::".join([scope.name for scope in self.scopes if scope.name] + [name])

    def end(self, line, text=None):
        statement = self.statement if text is None else text
        if self.scopes[-1].kind == "enum":
            match = re.match(r"\s*(\w+)", statement)
            kind, names = ("value", [match.group(1)]) if match else (None, [])
        else:
            kind, names = declared(statement)
        self.last = []
        if kind and self.public() and not (kind == "class" and text is None):
            doc = [comment_text(c) for c in self.comments]
            if kind == "field" and self.scopes[-1].kind == "namespace":
                kind = "constant"
            self.last = [Declaration(self.full(n), kind, list(doc), self.header) for n in names]
            self.found += self.last
        self.last_line = line
        self.comments, self.statement = [], ""
        return kind, names

    def take(self, token, line):
        if token.startswith("//"):
            self.take_comment(token, line)
        elif self.skipping:
            self.skipping += (token == "{") - (token == "}")
            if not self.skipping and not self.in_initialiser:
                self.statement = ""
                self.last_line = line
        elif token in "()" and len(token) == 1:
            self.parens += 1 if token == "(" else -1
            self.statement += token
        elif self.parens:
            self.statement += token
        elif token == ";":
            self.in_initialiser = False
            self.end(line)
        elif token == "," and self.scopes[-1].kind == "enum":
            self.end(line)
        elif token == "{":
            self.open(line)
        elif token == "}":
            if self.scopes[-1].kind == "enum" and self.statement.strip():
                self.end(line)
            if len(self.scopes) > 1:
                self.scopes.pop()
            self.statement, self.comments = "", []
        elif token == ":" and re.search(r"\b(public|private|protected)\s*$", self.statement):
            self.scopes[-1].public = self.statement.strip() == "public"
            self.statement, self.comments = "", []
        elif token == "\n":
            self.statement += " "
            if not self.statement.strip() and self.comments and line > self.last_comment_line:
                self.comments = []  # a comment on its own, with an empty line behind it
        else:
            self.statement += token

    def take_comment(self, token, line):
        if self.skipping:
            return
        text = comment_text(token)
        trailing = self.last and line == self.last_line and not self.statement.strip()
        if trailing:
            for declaration in self.last:
                declaration.doc.append(text)
        elif not self.statement.strip():
            self.comments.append(token)
        self.last_comment_line = line

    def open(self, line):
        text = self.statement
        namespace = re.match(r"\s*(inline\s+)?namespace\b.*?(\w+)\s*$", text)
        if namespace:
            public = namespace.group(2) != "detail"
            self.scopes.append(Scope("namespace", "", public))
            self.statement, self.comments = "", []
            return
        kind, names = declared(text)
        if kind in ("class", "enum"):
            self.end(line, text)
            is_class = re.match(r"\s*(template\s*<[^>]*>\s*)?class\b", text)
            self.scopes.append(Scope(kind, names[0], not is_class))
        elif kind == "function":
            self.end(line, text)
            self.skipping = 1
        else:
            self.skipping, self.in_initialiser = 1, True


def declarations(headers):
    """Of all headers, in their order; what is declared more than once is there once, with all that is said of it."""
    found = {}
    for header in headers:
        for one in Reader(header).found:
            if one.name in found:
                if one.doc and one.doc != found[one.name].doc:
                    found[one.name].doc.extend(["", *one.doc])
            else:
                found[one.name] = one
    return list(found.values())


SPEECH = [
    (r"@copydoc\s+\S+", ""),
    (r"\b(std|Eigen|seam)::", ""),
    (r"\bnullopt\b|\bnullptr\b", "None"),
    (r"(\w)::(\w)", r"\1.\2"),
    (r"\bfalse\b", "False"),
    (r"\s*Neither allocates nor throws( after construction)?\.", ""),  # Python's side of it does
]


def python_speech(text):
    for pattern, by in SPEECH:
        text = re.sub(pattern, by, text)
    return text


def docstring(doc):
    """Comment lines as Python's users know them: prose, then Args, Returns, Raises."""
    prose, sections, now = [], {"Args": [], "Returns": [], "Raises": []}, None
    lines = "\n".join(re.sub(r"(?<=\S)\s+@(?=param|return|throws)", "\n@", line) for line in doc).split("\n")
    for line in (python_speech(line) for line in lines):
        command = re.match(r"\s*@(param|return|throws)\s*(?:\[\w+\]\s*)?(.*)", line)
        if command:
            now = {"param": "Args", "return": "Returns", "throws": "Raises"}[command.group(1)]
            text = command.group(2)
            if now == "Args":
                text = re.sub(r"^(\w+(?:, \w+)*)\s+", r"\1: ", text)
            elif now == "Raises":
                text = re.sub(r"^(\w+)\s*", r"\1: ", text).rstrip(": ")
            sections[now].append([text])
        elif now and line.strip():
            sections[now][-1].append(line.strip())
        else:
            now = None
            prose.append(line.rstrip())
    text = "\n".join(prose).strip("\n")
    for title, entries in sections.items():
        if entries:
            body = "\n".join(textwrap.indent("\n    ".join(entry), "    ") for entry in entries)
            text += f"\n\n{title}:\n{body}"
    return text.strip("\n")


def literal(text):
    """Of C++; strings of more than 60 kB are beyond what compilers must take, and no comment is."""
    return 'R"doc(' + text + ')doc"'


def write_table(path, headers):
    rows = sorted((one.name, docstring(one.doc)) for one in declarations(headers))
    lines = [f'    {{"{name}", {literal(doc)}}},' for name, doc in rows if doc]
    Path(path).write_text(
        '#include "plugin/python/src/docstrings.hpp"\n\nnamespace seam::python {\n\n'
        "const std::map<std::string_view, const char*>& docstrings() {\n"
        "  static const std::map<std::string_view, const char*> table{\n"
        + "\n".join(lines)
        + "\n  };\n  return table;\n}\n\n}  // namespace seam::python\n"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("headers", nargs="+")
    parser.add_argument("--docstrings", metavar="FILE.cpp")
    options = parser.parse_args()
    if options.docstrings:
        write_table(options.docstrings, options.headers)
        return
    for one in declarations(options.headers):
        print(f"{one.header:28} {one.kind:9} {one.name}")


if __name__ == "__main__":
    sys.exit(main())
