"""A file with a text, as an instrument or a lab leaves it."""

import re

import openpyxl
import pytest

from mixedlub.importers.wizard import run


class Terminal:
    """A user who replies by a word of the question: with a text, "?", or "@b" for the choice of that letter."""

    def __init__(self, replies):
        self.left = {word: list(lines) for word, lines in replies.items()}
        self.said, self.forms, self.shown = [], [], {}

    def say(self, line):
        self.said.append(line)
        question = re.match(r" *(\d+)  (\S.*)", line)
        if "before anything is written" in line:
            self.shown = {}
            self.forms.append(self.shown)
        elif question:
            self.shown[question[1]] = question[2]

    def ask(self, prompt):
        if prompt.startswith("Write this case"):
            return self.left.get("Write this case", [""])[0]
        parts = []
        for number, question in self.shown.items():
            lines = next((lines for word, lines in self.left.items() if word in question and lines), [])
            reply = lines.pop(0) if lines else ""
            parts.append(reply and (f"{number}{reply.lstrip('@')}" if reply[0] in "?@" else f"{number}={reply}"))
        assert len(self.forms) < 8
        return "; ".join(filter(None, parts))


@pytest.fixture
def at_terminal():
    def answered(path, out, settings, replies):
        user = Terminal(replies)
        run([path], out, settings, ask=user.ask, say=user.say)
        return user

    return answered


@pytest.fixture
def file(tmp_path):
    def write(text, name="t.csv", encoding="utf-8"):
        path = tmp_path / name
        path.write_text(text, encoding=encoding)
        return path

    return write


@pytest.fixture
def book(tmp_path):
    def write(name="t.xlsx", formats=None, **sheets):
        made = openpyxl.Workbook()
        made.remove(made.active)
        for title, rows in sheets.items():
            sheet = made.create_sheet(title)
            for row in rows:
                sheet.append(row)
            for place, form in (formats or {}).items():
                sheet[place].number_format = form
        made.save(tmp_path / name)
        return tmp_path / name

    return write
