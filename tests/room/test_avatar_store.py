"""The store of own avatars: each once, none beyond what it may, and no room that keeps others out."""

import hashlib
from contextlib import nullcontext, suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from room.avatars import AvatarStore, digest_of
from room.errors import NotAllowed


def test_the_store_keeps_each_avatar_once_and_no_more_than_it_may():
    store = AvatarStore(most_bytes=13)
    digest = store.put(b"abcdef", ("lab", "ada"))
    assert store.put(b"abcdef", ("lab", "ben")) == digest == hashlib.sha256(b"abcdef").hexdigest()
    assert store.kept_bytes == 6
    with pytest.raises(NotAllowed):
        store.put(b"ghijkl", ("lab", "cy"))
    assert store.get(digest, "lab") == b"abcdef"
    assert store.get(digest, "hall") is None, "another room's"
    store.drop(("lab", "ada"))
    assert store.get(digest, "lab") == b"abcdef"
    store.drop(("lab", "ben"))
    assert store.kept_bytes == 0
    assert store.put(b"ghijkl", ("lab", "cy")) != digest


@given(st.lists(st.tuples(st.sampled_from("abc"), st.integers(0, 20), st.integers(1, 40)), max_size=60))
def test_no_room_keeps_others_from_the_store(brought):
    """However three of them fill it, a sixteenth is left for a fourth, and who is refused wears what they wore."""
    store = AvatarStore(most_bytes=160)
    worn: dict[tuple[str, str], bytes] = {}
    for number, (room, person, size) in enumerate(brought):
        wearer, content = (room, str(person)), number.to_bytes(1, "little") * size
        with suppress(NotAllowed):
            store.put(content, wearer)
            worn[wearer] = content
        assert store.kept_bytes == sum(map(len, worn.values())) <= 150
        for (place, _), kept in worn.items():
            assert store.get(digest_of(kept), place) == kept
    store.put(b"x" * 5, ("late", "ada"))


@given(st.lists(st.integers(1, 40), max_size=40))
def test_a_room_alone_has_three_quarters_of_the_store(sizes):
    store = AvatarStore(most_bytes=160)
    for number, size in enumerate(sizes):
        fits = store.kept_bytes + size <= 120
        with nullcontext() if fits else pytest.raises(NotAllowed):
            store.put(number.to_bytes(1, "little") * size, ("lab", str(number)))


def test_who_brings_the_same_or_a_smaller_one_is_never_refused():
    store = AvatarStore(most_bytes=160)
    for number in range(4):
        store.put(bytes([number]) * 30, ("lab", str(number)))
    store.put(b"b" * 20, ("hall", "ben"))
    with pytest.raises(NotAllowed) as told:
        store.put(b"a" * 31, ("lab", "0"))
    assert not told.value.again, "a page would bring 32 MiB twice a minute"
    digest = store.put(bytes([0]) * 30, ("lab", "0"))
    assert store.get(digest, "lab")
    assert store.put(b"c" * 29, ("lab", "0")) != digest
    assert store.get(digest, "lab") is None
