"""The command line: parses, calls the library, prints, and maps errors to exit codes."""

from __future__ import annotations

import gc
import os
import sys
from pathlib import Path
from typing import Annotated

import cyclopts
from cyclopts import Parameter

from sketchloft import __version__
from sketchloft.errors import OutputError, SketchloftError, UsageError

__all__ = ["main"]

COMMANDS = {
    "build": "Build a CAD model from a cloud of points.",
    "sample": "Draw a cloud of a known solid.",
    "measure": "Measure a model against its goal.",
    "compare": "Compare slice-and-loft with the 3D alpha shape and the octree boundary.",
    "info": "Tell what is in a file.",
}
EXIT_CODES = (
    "Exit codes: 0 done, 2 wrong option, 3 unreadable input, 4 cloud that is no solid, 5 a stage that cannot "
    "go on, 6 invalid solid, 7 unwritable output."
)
INTERRUPTED = 130


def _application() -> cyclopts.App:
    """Build the application; a new one for each run, because a config file becomes part of it."""
    app = cyclopts.App(
        name="sketchloft",
        help="Turn a cloud of points drawn in mid-air into a CAD solid.",
        help_epilogue=EXIT_CODES,
        help_format="plaintext",
        version=__version__,
        result_action="return_value",
        suppress_keyboard_interrupt=False,
    )
    app.meta.suppress_keyboard_interrupt = False  # it is said what became of the output
    # Commands are named, not imported: each is loaded when it is called, which keeps --help instant.
    for name, text in COMMANDS.items():
        app.command(f"sketchloft.commands.{name}:{name}", name=name, help=text)
    app.register_install_completion_command(help="Install completion for this shell.")

    @app.meta.default
    def run(
        *tokens: Annotated[str, Parameter(show=False, allow_leading_hyphen=True)],
        config: Annotated[
            Path | None,
            Parameter(help="TOML file with options, a table per command; options given here win."),
        ] = None,
    ) -> object:
        if config is not None:
            if not config.is_file():
                raise UsageError(f"{config}: is no file; give a TOML file with a table such as [build]")
            app.config = (cyclopts.config.Toml(config.resolve()),)
        return app(tokens, exit_on_error=False, print_error=False)

    return app


def main(arguments: list[str] | None = None) -> None:
    """Run the command line and leave with its exit code."""
    # The matrices are small: a second thread only waits for the first, and on a busy machine for long.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    code = _exit_code(sys.argv[1:] if arguments is None else arguments)
    if arguments is None:
        gc.freeze()  # to look through the kernel's types for garbage once more would take a third of a second
    sys.exit(code)


def _exit_code(arguments: list[str]) -> int:
    try:
        _application().meta(arguments, exit_on_error=False, print_error=False, result_action="return_value")
        sys.stdout.flush()
    except SketchloftError as error:
        return _failed(str(error), error.exit_code)
    except cyclopts.CycloptsError as error:
        return _failed(" ".join(str(error).split()), UsageError.exit_code)
    except BrokenPipeError:  # the reader of our output went away; that is its business
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (KeyboardInterrupt, ImportError) as error:
        # A library that is just loading may wrap the interrupt.
        if not isinstance(error, KeyboardInterrupt) and not isinstance(error.__cause__, KeyboardInterrupt):
            raise
        return _failed("interrupted; nothing was written", INTERRUPTED)
    except MemoryError:
        return _failed("there is not enough memory for this cloud; thin it first", OutputError.exit_code)
    return 0


def _failed(message: str, code: int) -> int:
    sys.stderr.write(f"sketchloft: {message}\n")
    return code
