"""Elements of HTML. Text is escaped unless it is ``Markup``, so that no text of a file becomes a part of the page."""

from __future__ import annotations

import json
from html import escape
from typing import Any, Final

from pkm_exact.wording import printable

_EMPTY: Final = frozenset({"input", "br"})


class Markup(str):
    """Text that is HTML already."""

    __slots__ = ()


def element(tag: str, *children: str, **attributes: str | int | bool | None) -> Markup:
    """An element with its children; of attributes the name's first underscores become hyphens, ``cls`` is class.

    Examples
    --------
    >>> element("td", "1 < 2", cls="number", data_value=1)
    '<td class="number" data-value="1">1 &lt; 2</td>'
    >>> element("p", element("b", "a"), " & b", hidden=True, title=None)
    '<p hidden><b>a</b> &amp; b</p>'
    """
    words = [tag]
    for key, value in attributes.items():
        name = "class" if key == "cls" else key.rstrip("_").replace("_", "-")
        if value is True:
            words.append(name)
        elif value is not None and value is not False:
            words.append(f'{name}="{_text(str(value))}"')
    opening = f"<{' '.join(words)}>"
    return Markup(opening if tag in _EMPTY else f"{opening}{joined(*children)}</{tag}>")


def joined(*children: str) -> Markup:
    """The children one after another.

    Examples
    --------
    >>> joined("<", Markup("<br>"))
    '&lt;<br>'
    """
    return Markup("".join(child if isinstance(child, Markup) else _text(child) for child in children))


def _text(value: str) -> str:
    return escape(printable(value), quote=True)


def embedded_json(content: Any) -> Markup:
    r"""JSON that can stand in a script element: no character of it can end the element or a line.

    Examples
    --------
    >>> print(embedded_json({"name": "</script>"}))
    {"name":"\u003c/script\u003e"}
    """
    text = json.dumps(content, ensure_ascii=True, allow_nan=False, separators=(",", ":"))
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return Markup(text)
