"""The exceptions of pkm_exact: one family, each message a sentence that says what to do."""

from __future__ import annotations


class PkmExactError(Exception):
    """Base class of every error that pkm_exact raises on purpose."""


class InputError(PkmExactError):
    """Input that cannot be used: names the file, the field, the value and the remedy."""


class ReconstructionError(PkmExactError):
    """A lift from modular images did not settle within the limits of the policy."""


class InternalContradictionError(PkmExactError):
    """Two steps of the exact engine disagree; no answer is given."""
