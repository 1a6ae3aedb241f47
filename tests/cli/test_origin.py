"""What an answer replaces: that of the same case, and of no other unasked."""

import shutil
from pathlib import Path

import pytest

from mixedlub.cli import main
from mixedlub.diagnosis.report import files

EXAMPLE = Path(__file__).parents[2] / "examples" / "case"
ANSWER = dict.fromkeys(files.WRITTEN, b"answer")


@pytest.fixture
def answered(tmp_path, monkeypatch):
    """A copy of the example with an answer in the folder `o`; diagnosing itself is left out."""
    monkeypatch.chdir(tmp_path)
    shutil.copytree(EXAMPLE, "rigs/case")
    files.write(ANSWER, Path("o"), files.case_origin(Path("rigs/case")))

    def diagnosed(*arguments):
        raise RuntimeError("diagnosed")

    monkeypatch.setattr("mixedlub.diagnosis.diagnose.diagnose_case", diagnosed)
    return Path("rigs/case")


def status(case, *options):
    """Exit status, which is 1 where the diagnosis was reached."""
    return main(["diagnose", str(case), "--out", "o", *options])


def test_the_same_case_replaces_its_answer_without_a_word(answered, capsys):
    assert status(answered) == 1
    assert "replace" not in capsys.readouterr().err


def test_an_edited_case_replaces_its_answer_and_says_so(answered, capsys):
    with (answered / "system.toml").open("a", encoding="utf-8") as system:
        system.write("# edited\n")
    assert status(answered) == 1
    assert "earlier state of rigs/case" in capsys.readouterr().err


def test_a_case_that_was_moved_is_the_same_case(answered, capsys):
    answered.rename("moved")
    assert status("moved") == 1
    assert "replace" not in capsys.readouterr().err


def test_the_answer_of_another_case_is_refused_with_the_way_out(answered, capsys):
    shutil.copytree(answered, "other/case")
    recorded = Path("other/case/recordings.csv")
    recorded.write_text("".join(recorded.read_text().splitlines(keepends=True)[:-1]))
    assert status("other/case") == 2
    told = capsys.readouterr().err
    assert "another case, ../rigs/case" in told
    assert "--replace" in told
    assert status("other/case", "--replace") == 1


@pytest.mark.parametrize("name", files.WRITTEN)
def test_a_file_that_no_run_wrote_is_refused(name, answered, capsys):
    Path("o", name).write_text("mine")
    assert status(answered) == 2
    assert f"holds {name}, not as a run left it" in capsys.readouterr().err
    assert Path("o", name).read_text() == "mine"


def test_two_cases_of_one_name_share_no_default_folder(answered, capsys):
    Path("o").rename("answer")
    Path("out/diagnose").mkdir(parents=True)
    files.write(ANSWER, Path("out/diagnose/case"), files.case_origin(answered))
    shutil.copytree(answered, "other/case")
    Path("other/case/system.toml").write_text((answered / "system.toml").read_text() + "# other\n")
    assert main(["diagnose", "other/case"]) == 2
    assert "another case" in capsys.readouterr().err
