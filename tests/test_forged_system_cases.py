"""Certificates of polynomial systems made by hand: both checkers say of each what is true."""

import pytest
from forged_local_algebras import FAR_TOO_DEAR, LABORIOUS, dear
from forged_local_algebras import ROWS as LOCAL_ALGEBRAS
from forged_products import ROWS as PRODUCTS
from forged_strides import ROWS as STRIDES
from forged_system_cases import ROWS
from handmade_systems import Content, sealed_bytes
from tables_of_rows import merged

from pkm_exact.certify import pure
from pkm_exact.certify.check import check_bytes

ALL = merged(ROWS, LOCAL_ALGEBRAS, PRODUCTS, STRIDES)


@pytest.mark.slow
@pytest.mark.in_corpus
@pytest.mark.parametrize("content", [dear(*FAR_TOO_DEAR), *LABORIOUS.values()], ids=["far too dear", *LABORIOUS])
def test_an_attempt_takes_its_part_of_the_work_only(content: Content) -> None:
    data = sealed_bytes(content)
    for verdict in (check_bytes(data), pure.check_bytes(data)):
        assert str(verdict.status) == "accepted", verdict.lines


@pytest.mark.parametrize("name", ALL)
def test_both_checkers_say_what_is_true(name: str) -> None:
    content, status = ALL[name]
    data = sealed_bytes(content)
    for verdict in (check_bytes(data), pure.check_bytes(data)):
        assert str(verdict.status) == status, verdict.lines
