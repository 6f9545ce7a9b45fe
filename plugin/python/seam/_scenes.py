"""The benchmark scenes."""

import json
import os
from pathlib import Path
from typing import Any, Iterable, List, Mapping, Optional, Union

from . import _seam


def _entry(value: Any) -> str:
    """As YAML has it; every JSON is YAML."""
    if isinstance(value, str):
        return value
    if hasattr(value, "tolist"):
        value = value.tolist()
    return json.dumps(value)


def scenes() -> List[str]:
    """Names of the scenes that come with seam, for `play` and `Scene.read`."""
    return [Path(path).stem for path in _seam._scene_files()]


def asset(path: str) -> str:
    """Path of a file that comes with seam: the PA-10 is `asset("pa10/pa10.urdf")`, a movement `asset("demos/reach.csv")`.

    Raises:
        FileNotFoundError: there is no such file (lists those beside it)
    """
    file = Path(_seam._own_folder(), "assets", path)
    if not file.exists():
        beside = sorted(other.name for other in file.parent.glob("*")) if file.parent.is_dir() else []
        raise FileNotFoundError(f"{file}: there is no such file, there are {', '.join(beside) or 'none'}")
    return str(file)


def play(
    scene: "Union[str, os.PathLike[str], _seam.Scene]",
    method: Union[_seam.Join, str, None] = None,
    dt: Optional[float] = None,
    *,
    set: Optional[Mapping[str, Any]] = None,
    allowed: "Iterable[Union[str, os.PathLike[str]]]" = (),
    **settings: Any,
) -> _seam.Recording:
    """Plays a scene in a Bullet world of its own, without a window, and records every tick.

    The same scene, method and dt give the same bits.

    Args:
        scene: name of one of seam's own (see `scenes`), path of a file, or a Scene
        method: joining method; None: the scene's own, else dmp3
        dt: Bullet's tick [s]; None: the scene's
        set: entries of the scene's file that are set anew, by their keys with dots:
            {"sequence.steps.0.until.before_end": 0.3}
        allowed: folders of which the scene may name files, beside its own and seam's
        settings: the same for keys without dots: arm="published", speed=1.2, control={"observer": 60}

    Returns:
        a Recording; what came of the scene (spilled_share, say) is in its `outcomes`

    Raises:
        Error: names file, line and key
    """
    entries = {**(set or {}), **settings}
    if isinstance(scene, _seam.Scene):
        if entries or allowed:
            raise TypeError("play: a Scene has been read already, give its settings to Scene.read")
    else:
        overrides = [f"{key}={_entry(value)}" for key, value in entries.items()]
        scene = _seam.Scene.read(os.fspath(scene), overrides, [os.fspath(folder) for folder in allowed])
    if method is None:
        method = _seam.Join.dmp3 if scene.method is None else scene.method
    return _seam._play(scene, method, scene.dt if dt is None else dt)
