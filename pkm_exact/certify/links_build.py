"""Certificates of mechanisms with passive bodies: their system, solved, or a box around one pose of all bodies.

The format is described in ``docs/certificates-links.md``; its schemas are ``links-certificate-1.schema.json`` and, of
mechanisms in a metric, ``links-certificate-2.schema.json`` in this folder.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.certify.build_constraints import constraint_entry
from pkm_exact.certify.system_build import system_certificate
from pkm_exact.geometry.inverse import UNIT_METRIC

if TYPE_CHECKING:
    from pkm_exact.links.link_solution import LinkSolution, StartBox

FORMAT: Final = "pkm_exact links certificate"
VERSION: Final = 1
IN_A_METRIC: Final = 2


def links_certificate(solution: LinkSolution) -> dict[str, Any]:
    """The certificate of a solution, as a JSON object with its digest.

    Examples
    --------
    >>> from pkm_exact.geometry.reader import read_links
    >>> from pkm_exact.links.link_engine import solve_links
    >>> found = links_certificate(solve_links(read_links("models/links/four-bar.toml")))
    >>> found["method"], found["system"]["claim"], found["system"]["real_solutions"]
    ('exact', 'complete', 2)
    """
    system = None
    if solution.system is not None:
        system = system_certificate(solution.system)
        del system["digest"]
    return sealed(
        {
            "format": FORMAT,
            "version": VERSION if solution.links.declared.metric == UNIT_METRIC else IN_A_METRIC,
            "mechanism": _mechanism(solution),
            "configuration": solution.configuration.name,
            "method": solution.method,
            "system": system,
            "box": None if solution.box is None else _box(solution.box),
            "notes": list(solution.notes),
        }
    )


def links_certificate_bytes(solution: LinkSolution) -> bytes:
    """What a certificate file holds."""
    return canonical_bytes(links_certificate(solution))


def _mechanism(solution: LinkSolution) -> dict[str, Any]:
    links = solution.links
    constraints, metric = links.locked(solution.configuration), links.declared.metric
    return {
        "name": links.name,
        "unit": links.declared.unit,
        "source": links.declared.source,
        "planar": links.is_planar,
        **({} if metric == UNIT_METRIC else {"metric": list(map(str, metric))}),
        "platform": links.platform,
        "bodies": [{"name": body.name, "motion": body.motion.name} for body in links.bodies],
        "joined": [
            {"bodies": list(pair), "constraint": constraint_entry(constraint, metric)}
            for constraint, pair in zip(constraints, links.joined, strict=True)
        ],
    }


def _box(box: StartBox) -> dict[str, Any]:
    return {"exponent": box.exponent, "radius": box.radius, "centre": [hex(value) for value in box.centre]}
