"""What the tests share: one small study, in a cache of their own."""

from pathlib import Path

import pytest
import snell


@pytest.fixture(scope="session")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("cache")


@pytest.fixture(scope="session")
def frame(cache: Path) -> snell.Frame:
    return snell.study(
        "ball",
        methods=["two-interface", "one-interface"],
        sweep={"medium.glass.eta": [1.2, 1.5]},
        resolution=24,
        positions=2,
        timing_s=0,
        quick=True,
        cache=cache,
    )
