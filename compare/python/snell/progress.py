"""How far the work is: a bar in notebooks, a line on terminals, else nothing."""

import contextlib
import html
import sys
from collections.abc import Callable, Iterator

#: Told the share that is done, 0 to 1, and what is being done.
Progress = Callable[[float, str], None]


@contextlib.contextmanager
def reporter(wanted: bool | None) -> Iterator[Progress]:
    """What is told of the work; it leaves nothing behind."""
    if wanted is not False and _in_notebook():
        from IPython.display import HTML, display

        handle = display(HTML(_bar(0.0, "")), display_id=True)
        try:
            yield lambda share, work: handle.update(HTML(_bar(share, work)))
        finally:
            handle.update(HTML(""))
    elif wanted or (wanted is None and sys.stderr.isatty()):
        try:
            yield _line
        finally:
            sys.stderr.write("\r\x1b[K")
    else:
        yield lambda share, work: None


def _in_notebook() -> bool:
    """True where there is a kernel that a notebook listens to."""
    if "IPython" not in sys.modules:
        return False
    shell = sys.modules["IPython"].get_ipython()
    return shell is not None and hasattr(shell, "kernel")


def _bar(share: float, work: str) -> str:
    text = html.escape(work)
    return f'<progress value="{share:.3f}" max="1"></progress> {100 * share:.0f} % {text}'


def _line(share: float, work: str) -> None:
    sys.stderr.write(f"\r\x1b[K{100 * share:3.0f} %  {work}")
    sys.stderr.flush()
