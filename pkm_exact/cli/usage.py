"""What is wrong with the words of a command line, in sentences like those about files: option, value, what to do."""

from __future__ import annotations

import click
from click.types import IntParamType


def usage_sentence(error: click.UsageError) -> str:
    """The message of an error of usage; of values that are no whole number, or of no such kind, in our words.

    Examples
    --------
    >>> option = click.Option(["--memory"], type=click.IntRange(64, 1024))
    >>> error = click.BadParameter("'300MB' is not a valid integer range.", param=option)
    >>> usage_sentence(error)
    "--memory: '300MB' is not a whole number; give one from 64 to 1024"
    >>> usage_sentence(click.BadParameter("7 is not in the range 64<=x<=1024.", param=option))
    '--memory: 7 is out of range; give a whole number from 64 to 1024'
    """
    if not isinstance(error, click.BadParameter) or isinstance(error, click.MissingParameter) or error.param is None:
        return error.format_message()
    name = "/".join(error.param.opts) if isinstance(error.param, click.Option) else error.param.human_readable_name
    if not isinstance(error.param.type, IntParamType):
        return f"{name}: {error.message}"
    value, _, kind = error.message.rpartition(" is not ")
    limits = _limits(error.param.type)
    if kind.startswith("in the range"):
        return f"{name}: {value} is out of range; give a whole number{limits}"
    return f"{name}: {value} is not a whole number; give one{limits or ' of digits only'}"


def _limits(kind: IntParamType) -> str:
    if not isinstance(kind, click.IntRange) or kind.min is None:
        return ""
    return f" from {kind.min} on" if kind.max is None else f" from {kind.min} to {kind.max}"
