"""Evidence: the stack is changed as long as a change explains the points better than it costs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from sketchloft.cloud import Floats
from sketchloft.exact_model import ExactModel, tied
from sketchloft.fit import climb, fit_density
from sketchloft.joins import natural_joins, sole_profile
from sketchloft.likelihood import beside_walls, value_of
from sketchloft.loft_start import loft_start
from sketchloft.segment_walls import evidence_price, spline_knots
from sketchloft.simpler_walls import profiles_like, walls_like
from sketchloft.stack import Run
from sketchloft.surface import basis_matrix
from sketchloft.surgery import with_run, with_runs, with_split, without_run
from sketchloft.wall.lofted import Lofted
from sketchloft.wall.profile import ArcProfile, Profile, SplineProfile
from sketchloft.wall.revolved import Revolved, radius_at

__all__ = ["MOST_NOISE", "coaxial", "improved"]

BESIDE = 6.0
"""Noise deviations from the walls within which points decide."""
STEPS = (2, 4)
HOPELESS = 40.0
"""A change that is still so much worse after the first few steps is given up."""
SHORT = 8.0
"""Runs shorter than so many noise deviations are taken for noise unless they gain a lot."""
SPLINE_GAIN = 20.0
"""What one free profile must gain over a chain of lines and arcs."""
SPLIT_SAMPLES = 41
SPANS = (4, 7, 11)
"""Knot spans of the free profiles that are tried."""
LOFTS = ((12, 2), (16, 4), (24, 4))
"""Poles around and spans along of the free walls that are tried."""
SHARP = 0.006
MOST_NOISE = 0.012
"""Largest noise that is believed, as a share of the size; more is a wall in the wrong place."""
PATIENCE = 400.0
"""`HOPELESS` for a free wall, which starts from contours and has far to go."""
Change = tuple[ExactModel, range, float]


def improved(points: Floats, model: ExactModel, together: float, rounds: int = 2) -> ExactModel:
    """Change runs, one at a time, as long as it pays.

    Parameters
    ----------
    points : (n, 3) float array
    model : ExactModel
        Fitted.
    together : float
        How many of the points go together.
    rounds : int
        How often all changes are looked through at most.
    """
    for _ in range(rounds):
        before = model
        model = _through(points, model, together, _merges)
        model = _splined(points, model, together)
        model = _through(points, model, together, _splits)
        model = _through(points, model, together, _swaps)
        model = _lofted(points, model, together)
        if model is before:
            break
    return model


def _through(points: Floats, model: ExactModel, together: float, changes) -> ExactModel:  # type: ignore[no-untyped-def]
    """Look through a kind of changes; after one that pays, start again from there."""
    place = 0
    while True:
        for place_now, change in enumerate(changes(model)):
            if place_now < place:
                continue
            better = _tried(points, model, change, together)
            place = place_now + 1
            if better is not None:
                model, place = better, 0 if changes is _merges else place_now
                break
        else:
            return model


def _lofted(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """One free wall for a chain of runs, or for a run that is not revolved, where it pays."""
    start = 0
    while start < len(model.stack.runs):
        stop = start + 1
        while stop < len(model.stack.runs) and _smooth(model, stop):
            stop += 1
        runs = model.stack.runs[start:stop]
        single = all(len(run.walls) == 1 for run in runs)
        revolved = all(isinstance(run.walls[0], Revolved) for run in runs)
        free = len(runs) == 1 and isinstance(runs[0].walls[0], Lofted)
        if single and not revolved and not free:
            ends = float(model.stack.breaks[start]), float(model.stack.breaks[stop])
            best: ExactModel | None = None
            for around, spans in LOFTS:
                wall = loft_start(points, ends, around, spans, together)
                if wall is None:
                    continue
                change = with_runs(model, start, stop - 1, Run((wall,)))
                better = _tried(
                    points,
                    best or model,
                    (change, range(start, start + 1), SPLINE_GAIN),
                    together,
                    hopeless=PATIENCE,
                )
                if better is None and best is not None:
                    break
                best = better or best
            model = best or model
            stop = start + 1 if best is not None else stop
        start = stop
    return model


def _smooth(model: ExactModel, k: int) -> bool:
    """Whether the walls below and above a break are one each and meet there, about."""
    below, above = model.stack.runs[k - 1], model.stack.runs[k]
    if len(below.walls) != 1 or len(above.walls) != 1:
        return False
    at = np.array([model.stack.breaks[k]])
    first, second = float(below.walls[0].area(at)[0]), float(above.walls[0].area(at)[0])
    return abs(np.sqrt(first) - np.sqrt(second)) < max(10 * model.sigma, 0.04)


def _tried(
    points: Floats,
    model: ExactModel,
    change: Change,
    together: float,
    *,
    hopeless: float = HOPELESS,
) -> ExactModel | None:
    """Fit a changed model beside its change; None if it does not pay."""
    candidate, runs, handicap = change
    if hopeless > HOPELESS:  # a bad model is a noisy one, and a better one need not be
        candidate = replace(candidate, sigma=min(candidate.sigma, SHARP))
    breaks = candidate.stack.breaks
    low = -np.inf if runs.start <= 1 else breaks[runs.start - 1]
    high = np.inf if runs.stop >= len(breaks) - 2 else breaks[runs.stop + 1]
    near = points[(points[:, 2] > low) & (points[:, 2] < high)]
    near = near[
        beside_walls(near, model, BESIDE * model.sigma) | beside_walls(near, candidate, BESIDE * model.sigma)
    ]
    if not len(near):
        return None
    if hopeless > HOPELESS:  # both are judged with the noise that suits them
        model, _, _ = climb(near, model, STEPS[1], noise=True, most=MOST_NOISE)
    old = value_of(near, model) / together - _price(model, len(points), together)
    wide = range(max(runs.start - 1, 0), min(runs.stop + 1, len(breaks) - 1))
    fitted = candidate
    for steps in STEPS:
        fitted, _, _ = climb(near, fitted, steps, runs=wide)
        new = value_of(near, fitted) / together - _price(fitted, len(points), together)
        if new < old + handicap - hopeless:
            return None
        if hopeless > HOPELESS:
            fitted = fit_density(points, fitted, 1)
            fitted, _, _ = climb(near, fitted, steps, runs=wide, noise=True, most=MOST_NOISE)
    fitted = natural_joins(fitted)
    new = value_of(near, fitted) / together - _price(fitted, len(points), together)
    return fitted if new > old + handicap else None


def _price(model: ExactModel, count: int, together: float) -> float:
    lengths = np.diff(model.stack.breaks)
    short = np.maximum(1 - lengths / (SHORT * model.sigma), 0.0)
    runs = len(lengths) * float(np.log(count / together))
    return evidence_price(model.parameters, count, together) + runs + 12.0 * float(short.sum())


def _merges(model: ExactModel) -> Iterator[Change]:
    runs = model.stack.runs
    count = len(runs)
    if count == 1:
        return
    order = np.argsort(np.diff(model.stack.breaks))
    for j in (int(k) for k in order):
        for heir in (j - 1, j + 1):
            if 0 <= heir < count:
                first = min(j, heir)
                yield without_run(model, j, heir), range(first, first + 1), 0.0
        if j in (0, count - 1):
            place = 0 if j == 0 else count - 2
            yield without_run(model, j, None), range(place, place + 1), 0.0


def _splined(points: Floats, model: ExactModel, together: float) -> ExactModel:
    """One free profile for a chain of revolved runs, with as many spans as pay."""
    start = 0
    while start < len(model.stack.runs):
        stop = start
        while stop < len(model.stack.runs) and sole_profile(model.stack.runs[stop]) is not None:
            if stop > start and not _continuous(model, stop):
                break
            stop += 1
        best: ExactModel | None = None
        for spans in SPANS if stop > start else ():
            source, last = (model, stop) if best is None else (best, start + 1)
            wall = _spline_through(source, start, last, spans)
            change = with_runs(source, start, last - 1, Run((wall,)))
            handicap = SPLINE_GAIN if best is None else 0.0
            better = _tried(points, source, (change, range(start, start + 1), handicap), together)
            if better is None and (best is not None or stop - start == 1):
                break
            best = better or best
        model = best or model
        start = start + 1 if best is not None else max(stop, start + 1)
    return model


def _splits(model: ExactModel) -> Iterator[Change]:
    """Two runs of lines or arcs for a free profile, cut where they fit it best."""
    for j, run in enumerate(model.stack.runs):
        wall = sole_profile(run)
        if wall is None or not isinstance(wall.profile, SplineProfile):
            continue
        low, high = float(model.stack.breaks[j]), float(model.stack.breaks[j + 1])
        z = np.linspace(low, high, SPLIT_SAMPLES)
        r = radius_at(wall.profile, z)[0]
        options = []
        for k in range(5, SPLIT_SAMPLES - 5):
            below, above = _closest(z[: k + 1], r[: k + 1]), _closest(z[k:], r[k:])
            options.append((below[0] + above[0], k, below[1], above[1]))
        _, k, first, second = min(options, key=lambda option: option[0])
        walls = [replace(wall, profile=profile) for profile in (first, second)]
        yield with_split(model, j, float(z[k]), *walls), range(j, j + 2), 0.0


def _closest(z: Floats, r: Floats) -> tuple[float, Profile]:
    """Squares left by the line or arc nearest to a profile, and that."""
    fits = [(float(((radius_at(p, z)[0] - r) ** 2).sum()), p) for p in profiles_like(z, r)]
    return min(fits, key=lambda fit: fit[0])


def _continuous(model: ExactModel, k: int) -> bool:
    first, second = sole_profile(model.stack.runs[k - 1]), sole_profile(model.stack.runs[k])
    if first is None or second is None:
        return False
    at = np.array([model.stack.breaks[k]])
    gap = abs(float(radius_at(first.profile, at)[0][0] - radius_at(second.profile, at)[0][0]))
    return gap < max(10 * model.sigma, 0.03)


def _spline_through(model: ExactModel, start: int, stop: int, spans: int) -> Revolved:
    breaks = model.stack.breaks
    heights, radii, centres, weights = [], [], [], []
    for j in range(start, stop):
        wall = sole_profile(model.stack.runs[j])
        if wall is None:
            continue
        length = float(breaks[j + 1] - breaks[j])
        z = breaks[j] + length * (np.arange(12) + 0.5) / 12
        heights.append(z)
        radii.append(radius_at(wall.profile, z)[0])
        weights.append(np.full(12, length))
        centres.append(length * wall.centre)
    z, r, w = np.concatenate(heights), np.concatenate(radii), np.sqrt(np.concatenate(weights))
    low, high = float(breaks[start]), float(breaks[stop])
    knots = spline_knots(low, high, spans, 0.05 * (high - low) + 0.01)
    basis = basis_matrix(knots, 3, z)
    smooth = 1e-3 * np.diff(np.eye(basis.shape[1]), 2, axis=0)
    rows = np.concatenate([w[:, None] * basis, smooth * float(w.mean())])
    poles = np.linalg.lstsq(rows, np.r_[w * r, np.zeros(len(smooth))], rcond=None)[0]
    return Revolved(np.sum(centres, axis=0) / (high - low), SplineProfile(knots, poles))


def _swaps(model: ExactModel) -> Iterator[Change]:
    breaks = model.stack.breaks
    for j, run in enumerate(model.stack.runs):
        for i, wall in enumerate(run.walls):
            for other in walls_like(wall, float(breaks[j]), float(breaks[j + 1])):
                walls = (*run.walls[:i], other, *run.walls[i + 1 :])
                yield with_run(model, j, Run(walls, run.holes)), range(j, j + 1), 0.0


def coaxial(
    points: Floats, model: ExactModel, together: float, *, tilt: bool
) -> tuple[ExactModel, Floats, Floats]:
    """Let all revolved walls have one axis, if it pays.

    Returns
    -------
    ExactModel
    (n, 3) float array
        The points, turned so that the axis is along z where the tilt is free.
    (3, 3) float array
        The rotation: new points = old points @ rotation.
    """
    places = [
        (j, i)
        for j, run in enumerate(model.stack.runs)
        for i, wall in enumerate(run.walls)
        if isinstance(wall, Revolved)
    ]
    still = model, points, np.eye(3)
    if len(places) < 2:
        return still
    turn = _through_centres(model, places) if tilt else np.eye(3)
    turned = points @ turn
    pairs = [((*places[0], k), (*place, k)) for place in places[1:] for k in (0, 1)] + _tangents(model)
    near = turned[beside_walls(turned, model, 2 * BESIDE * model.sigma)]
    change, _, rotation = climb(near, tied(model, pairs), 12, tilt=tilt)
    change = natural_joins(change)
    old = value_of(points, model) / together - _price(model, len(points), together)
    turned = turned @ rotation
    new = value_of(turned, change) / together - _price(change, len(points), together)
    return (change, turned, turn @ rotation) if new > old else still


def _tangents(model: ExactModel) -> list[tuple[tuple[int, int, int], tuple[int, int, int]]]:
    """Radii of spheres and of the cylinders they run into."""
    place = {"cylinder": 2, "sphere": 3}
    return [
        (
            (k - 1, 0, place[model.stack.runs[k - 1].walls[0].kind]),
            (k, 0, place[model.stack.runs[k].walls[0].kind]),
        )
        for k, join in enumerate(model.joins)
        if join == "tangent"
    ]


def _through_centres(model: ExactModel, places: list[tuple[int, int]]) -> Floats:
    """Rotation that brings the line through the walls' centres along z."""
    breaks = model.stack.breaks
    at, weights = [], []
    for j, i in places:
        wall = model.stack.runs[j].walls[i]
        if isinstance(wall, Revolved):
            height = (breaks[j] + breaks[j + 1]) / 2
            if isinstance(wall.profile, ArcProfile) and wall.profile.offset is None:
                height = wall.profile.height
            at.append([*wall.centre, height])
            weights.append(breaks[j + 1] - breaks[j])
    z = np.array(at)[:, 2]
    if np.ptp(z) < 1e-3:
        return np.eye(3)
    slope = np.polyfit(z, np.array(at)[:, :2], 1, w=np.sqrt(weights))[0]
    if np.hypot(*slope) > STEEPEST:
        return np.eye(3)
    axis = np.array([*slope, 1.0]) / np.sqrt(1 + slope @ slope)
    a, b = axis[0], axis[1]
    # The smallest rotation that takes the axis to z (Rodrigues).
    cross = np.array([[0, 0, a], [0, 0, b], [-a, -b, 0.0]])
    rotation = np.eye(3) - cross + cross @ cross / (1 + axis[2])
    return np.asarray(rotation.T, dtype=np.float64)


STEEPEST = 0.2
"""Largest slope of the line through the centres that is taken for a common axis seen askew."""
