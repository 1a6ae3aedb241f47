"""A file with a text, as an instrument or a lab leaves it."""

import openpyxl
import pytest


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
