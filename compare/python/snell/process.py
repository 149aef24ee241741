"""The program, in a process of its own."""

import functools
import json
import os
import shutil
import subprocess
import sys
import sysconfig
import threading
import warnings
from collections.abc import Iterable, Sequence
from importlib import metadata
from pathlib import Path
from typing import IO, Any

from snell.progress import Progress, reporter

#: Commands that tell how far they are.
_TELLING = ("study", "reference")


class SnellError(RuntimeError):
    """The program could not do what it was asked.

    Its text says where, what, and what to write instead.

    Attributes:
        exit_status: What the program ended with: 2 for bad input, negative for the
            number of the signal that killed it.
    """

    def __init__(self, message: str, exit_status: int = 2) -> None:
        super().__init__(message)
        self.exit_status = exit_status


class SnellWarning(UserWarning):
    """Something doubtful in what was asked, such as a scene that a method cannot show."""


def program() -> Path:
    """The program that is run: ``$SNELL``, or the one of this environment, or of PATH.

    Raises:
        SnellError: If there is none, or it is of another version than this package.
    """
    return _checked(os.environ.get("SNELL"))


@functools.cache
def _checked(named: str | None) -> Path:
    path = Path(named) if named else _installed()
    own = metadata.version("snell")
    try:
        told = subprocess.run([path, "--version"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise SnellError(f"{path} cannot be run: {error}") from error
    found = told.stdout.split()[-1:]
    if found != [own]:
        raise SnellError(
            f"{path} is of version {' '.join(found)}, and this package of {own}\n"
            "install both from one wheel, or name the program with the variable SNELL"
        )
    return path


def _installed() -> Path:
    name = "snell.exe" if sys.platform == "win32" else "snell"
    schemes = {sysconfig.get_default_scheme(), sysconfig.get_preferred_scheme("user")}
    for scheme in sorted(schemes):
        path = Path(sysconfig.get_path("scripts", scheme)) / name
        if path.is_file():
            return path
    if found := shutil.which(name):
        return Path(found)
    raise SnellError(
        "the program snell is not in this environment\n"
        "install the wheel, which holds it, or name the program with the variable SNELL"
    )


def call(*words: str | os.PathLike[str], progress: bool | None = None) -> list[dict[str, Any]]:
    """Runs a command of the program: what ``snell WORDS --json`` answers.

    Args:
        words: The command and its arguments, as on the command line.
        progress: Show how far the work is. ``None``: in notebooks and on terminals.

    Returns:
        The objects of the answer; each names its form in the field ``schema``.

    Raises:
        SnellError: If the program could not do it, or was killed. A gate that fails
            (exit status 1) or cannot be told (3) is an answer and no error.
    """
    texts = [os.fspath(word) for word in words]
    command = [os.fspath(program()), *texts, "--json"]
    if texts and texts[0] in _TELLING and "--progress" not in texts:
        command += ["--progress", "json"]
    with (
        reporter(progress) as report,
        subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            errors="replace",
        ) as process,
    ):
        try:
            answer, message = _listen(process, report)
        except BaseException:  # An interrupted cell leaves no process behind.
            process.kill()
            raise
    if process.returncode not in (0, 1, 3) or (process.returncode == 1 and not answer):
        raise SnellError(_reason(message, process.returncode), process.returncode)
    return [json.loads(line) for line in answer if line.strip()]


def _listen(process: "subprocess.Popen[str]", report: Progress) -> tuple[list[str], list[str]]:
    """Lines of the answer, and of what the program said besides."""
    answer: list[str] = []
    assert process.stdout and process.stderr
    reader = threading.Thread(target=_keep, args=(process.stdout, answer), daemon=True)
    reader.start()
    message: list[str] = []
    for line in process.stderr:
        told = _object(line)
        if told.get("schema") == "snell.progress/1":
            report(float(told["share"]), str(told["work"]))
        elif line.startswith("warning: "):
            warnings.warn(line.removeprefix("warning: ").strip(), SnellWarning, stacklevel=5)
        else:
            message.append(line.rstrip())
    process.wait()
    reader.join()
    return answer, message


def _keep(stream: IO[str], lines: list[str]) -> None:
    lines.extend(stream)


def _object(line: str) -> dict[str, Any]:
    if not line.startswith("{"):
        return {}
    try:
        found: dict[str, Any] = json.loads(line)
    except ValueError:
        return {}
    return found


def _reason(message: Sequence[str], status: int) -> str:
    for line in reversed(message):
        told = _object(line)
        if told.get("schema") == "snell.error/1":
            return str(told["message"])
    said = "\n".join(message)
    if status < 0:
        return f"the program was killed by signal {-status}\n{said}".strip()
    return said or f"the program ended with status {status} and said nothing"


def words(option: str, values: Iterable[object]) -> list[str]:
    """The option once before each value."""
    return [word for value in values for word in (option, str(value))]
