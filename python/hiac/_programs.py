"""The programs that are installed with the package, run as processes of their own.

Readers of foreign files fork, use libraries that are not safe against damaged files, and may meet
other versions of these libraries in the host. In processes of their own they are safe, whatever
threads the host has, and can be ended at any moment.
"""
from __future__ import annotations

import os
import pathlib
import subprocess

from . import _core
from .errors import Cancelled, Error, InputError, JudgementError, UsageError

_FOLDER = pathlib.Path(__file__).parent / "programs"
_ERRORS = {1: JudgementError, 2: UsageError, 3: InputError}
_PAUSE = 0.02  # seconds between looks at a cancellation


def path_of(program: str) -> str:
    """The program's file. Raises Error where it was not built."""
    path = _FOLDER / program
    if not path.exists():
        raise Error(f"{program}: not a part of this installation of hiac ({path} expected)")
    return str(path)


class Run:
    """What a program left: its standard output, open for reading, and its lines of notes."""

    def __init__(self, output: int, lines: list[str], code: int) -> None:
        self.output, self.lines, self.code = output, lines, code

    def text(self) -> str:
        return os.pread(self.output, os.fstat(self.output).st_size, 0).decode()

    def mesh(self) -> _core.Mesh:
        """The zoo mesh on standard output, whose memory is used as it is."""
        return _core.read_zoo(f"/proc/self/fd/{self.output}")

    def __enter__(self) -> Run:
        return self

    def __exit__(self, *_: object) -> None:
        os.close(self.output)


def run(
    program: str,
    arguments: list[str],
    mesh: _core.Mesh | None = None,
    cancel: _core.Cancellation | None = None,
    accepted: tuple[int, ...] = (0,),
) -> Run:
    """Runs a program, with a mesh as its standard input, and waits for its end.

    Raises what its exit code stands for, unless that is accepted; Cancelled on request. An
    exception while it runs (KeyboardInterrupt) ends it.
    """
    path = path_of(program)
    memory = [os.memfd_create(name) for name in ("hiac output", "hiac messages")]
    output, messages = memory
    stdin = None
    try:
        if mesh is not None:
            stdin = os.memfd_create("hiac mesh")
            memory.append(stdin)
            _core.write_zoo_stream(mesh, stdin)
            os.lseek(stdin, 0, os.SEEK_SET)
        code = _wait([path, *arguments], stdin, output, messages, cancel)
        lines = _lines_of(program, os.pread(messages, os.fstat(messages).st_size, 0).decode())
        if code not in accepted:
            what = lines[-1] if lines else f"{program} ended with status {code}"
            raise _ERRORS.get(code, Error)(what)
        memory.remove(output)
        return Run(output, lines, code)
    finally:
        for descriptor in memory:
            os.close(descriptor)


def _wait(command, stdin, output, messages, cancel) -> int:
    with subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL if stdin is None else stdin,
        stdout=output,
        stderr=messages,
        start_new_session=True,  # an interrupt at the terminal is this process's to hear
    ) as process:
        try:
            while True:
                try:
                    return process.wait(_PAUSE if cancel is not None else None)
                except subprocess.TimeoutExpired:
                    if cancel.requested:
                        raise Cancelled("cancelled") from None
        finally:
            if process.poll() is None:
                process.kill()


def _lines_of(program: str, text: str) -> list[str]:
    hint = f" (see {program} --help)"
    return [line.removeprefix(f"{program}: ").removesuffix(hint)
            for line in text.splitlines() if line]
