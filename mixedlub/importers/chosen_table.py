"""Choice among several tables of a text."""

from __future__ import annotations

from mixedlub.importers.base import Answers, Question
from mixedlub.importers.input_file import InputFile
from mixedlub.importers.recognised import holds_reading
from mixedlub.importers.text_table import TABLE, Sheet
from mixedlub.kinds import NATIVE
from mixedlub.kinds import kind as kind_of
from profiles.errors import InputError


def chosen_table(file: InputFile, decimal: str | None, answers: Answers) -> tuple[Sheet, list[Question], list[str]]:
    """Table to read, a question if several hold a reading, and a note on the tables not read."""
    number = answers.get(TABLE)
    if number is not None and (isinstance(number, bool) or not str(number).isdecimal()):
        raise InputError("must be the number of a table of the file, from 1", where=TABLE, value=number)
    sheet = file.table(decimal, None if number is None else int(number))
    if not sheet.tables:
        return sheet, [], []
    kinds = [answers["kind"]] if answers.get("kind") in NATIVE else NATIVE
    readings = dict.fromkeys(quantity for kind in kinds for quantity in kind_of(kind).quantities)
    every = {place: file.table(decimal, place) for place in range(1, len(sheet.tables) + 1)}
    likely = [place for place, table in every.items() if number is None and holds_reading(table.cells, readings)]
    if likely:
        sheet = every[max(likely, key=lambda place: len(every[place].lines))]
    read = next(place for place, table in every.items() if table.lines == sheet.lines)
    described = {place: f"{place} ({text})" for place, text in enumerate(sheet.tables, start=1)}
    others = ", ".join(text for place, text in described.items() if place != read)
    note = f"table {described[read]} is read, not {others}; {TABLE} names another"
    text = f"Which of its tables to read, {', '.join(described.values())}; import each as a case of its own"
    question = Question(TABLE, text, str(read), offered=True)
    return sheet, [question] if len(likely) > 1 else [], [note]
