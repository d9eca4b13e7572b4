"""Finds the messages of the program in its sources: what is refused, warned of, and noted.

A message is a string literal with a blank in it, with the literals beside it joined, that is no
description of an option or of a command. Its kind follows from the statement that it is in.
"""

import os
import re
from dataclasses import dataclass

from tables import ROOT

SOURCE = os.path.join(ROOT, "src")

TOKENS = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|'
    r"'(?:\\.|[^'\\\n])+'|[;{}()]|[^\s;{}()\"'/]+|\s+|.", re.S)

# Statements with these parts describe options and commands, or are data of other kinds.
DESCRIPTIONS = re.compile(
    r"\badd_(?!reading)\w+\s*\(|->add_|\bnote_of\b|documentation_of|default_text|\.unit\b|Command\{|"
    r"#include|begin_group|->type_name|\bsummary\b|static_assert|examples|sections|description\(")
ROOMS_WITHOUT = ("src/commands/usage/help", "src/commands/usage/man", "src/commands/usage/bash",
                 "src/commands/usage/zsh", "src/commands/usage/fish", "src/commands/page/page_temp",
                 "src/report_page", "src/ibmfair/picture", "src/ibmfair/shapes/shape_table")

OPTION = r"(?<![\w-])--[a-z][a-z0-9-]*"

KINDS = (("refusal", r"\bthrow\b|fail\w*\s*\(|\berror\s*[=(]|Failure\(|Misuse\(|refuse\w*\("),
         ("warning", r"warning"),
         ("note", r"note|detail|remark|left_out"))


@dataclass
class Message:
    path: str  # from the root of the project
    line: int
    kind: str  # refusal, warning, note, or part: a phrase that a message is made of
    text: str

    def options(self):
        """Pairs of a long option that the message names, and the command in whose line it stands,
        as in "`fill --stitch` splits them"; None for the command that prints the message."""
        pairs, rest = [], self.text
        for line in re.findall(r"`[^`]*`", self.text):
            command = re.match(r"`(?:ibmfair )?(\w+) ", line)
            if command:
                pairs += [(option, command[1]) for option in re.findall(OPTION, line)]
                rest = rest.replace(line, "")
        return pairs + [(option, None) for option in re.findall(OPTION, rest)]


def tokens_of(code):
    """Pairs of a token and its line, without comments and white space."""
    line = 1
    for match in TOKENS.finditer(code):
        token = match.group()
        if not token.startswith(("//", "/*")) and not token.isspace():
            yield token, line
        line += token.count("\n")


def literal(token):
    return token[1:-1].replace('\\"', '"').replace("\\n", " / ").replace("\\\\", "\\")


def is_data(text):
    """Whether the text is a command line of an example, or the start of a file."""
    return re.match(r"ibmfair (?!\w+ --)\w+ |ply / |property |element |end_header", text)


def is_literal(token):
    return token.startswith('"')


def statements(code):
    """Lists of tokens that belong together: what is between ; { and }, except that braces in
    parentheses and initializers do not end a statement."""
    statement, depth = [], 0
    for token, line in tokens_of(code):
        inner = depth > 0 or (statement and statement[-1][0].endswith(("=", ",", "return")))
        if token in "()":
            depth = max(0, depth + (1 if token == "(" else -1))
        if token == ";" or (token in "{}" and not inner):
            yield statement
            statement, depth = [], 0
        else:
            statement.append((token, line))
    yield statement


def messages_in(path):
    with open(os.path.join(ROOT, path)) as file:
        code = file.read()
    for statement in statements(code):
        plain = " ".join(token for token, _ in statement if not is_literal(token))
        if DESCRIPTIONS.search(plain.replace(" (", "(").replace(" {", "{")):
            continue
        kind = next((name for name, pattern in KINDS if re.search(pattern, plain)), "part")
        text, first = "", 0
        for token, line in statement + [("", 0)]:
            if is_literal(token):
                first = first if text else line
                text += literal(token)
            elif text:
                if " " in text.strip() and re.search(r"[a-z]{2}", text) and not is_data(text):
                    yield Message(path, first, kind, text)
                text = ""


def source_files():
    for folder, _, names in sorted(os.walk(SOURCE)):
        for name in sorted(names):
            path = os.path.relpath(os.path.join(folder, name), ROOT)
            if name.endswith((".cpp", ".h")) and not path.startswith(ROOMS_WITHOUT):
                yield path


def all_messages():
    return [message for path in source_files() for message in messages_in(path)]


def includes_of(path):
    with open(os.path.join(ROOT, path)) as file:
        return ["src/" + name for name in re.findall(r'#include "([^"]+)"', file.read())]


class Reach:
    """The files that a command can run code of, by the headers that its files include. A header
    stands for the source of its name, or, if there is none, for the sources of its room that include
    it and have no header of their own. This is more than what runs. The files of commands are behind
    no header: the table of commands refers to them."""

    def __init__(self):
        self.includes = {path: includes_of(path) for path in source_files()}
        self.behind = {}
        for path, headers in self.includes.items():
            own = path.removesuffix(".cpp") + ".h"
            if own in self.includes:
                self.behind.setdefault(own, []).append(path)
            elif path.endswith(".cpp") and os.path.dirname(path) != "src/commands":
                for header in headers:
                    if (os.path.dirname(header) == os.path.dirname(path)
                            and header.removesuffix(".h") + ".cpp" not in self.includes):
                        self.behind.setdefault(header, []).append(path)

    def files(self, roots):
        reached, waiting = set(), list(roots)
        while waiting:
            path = waiting.pop()
            if path not in reached and path in self.includes:
                reached.add(path)
                waiting += self.includes[path] + self.behind.get(path, [])
        return reached
