"""Slots of the FPGA: what gives way, what stays, what serves for another."""

from hypothesis import given
from hypothesis import strategies as st

from controller.device.loop.playing.slot_cache import MIN_UNPINNED, SlotCache


def same(_key):
    """No key is for one focus: none serves for another."""
    return


def put(cache, key):
    """Play a waveform as the playback does; whether it had to be uploaded."""
    resident = cache.find(key)
    if resident is not None:
        cache.use(resident)
        return False
    cache.keep(key, cache.take())
    return True


def test_the_least_recently_played_waveform_is_evicted():
    cache = SlotCache(3, same)
    uploads = [put(cache, key) for key in (1, 2, 3, 1, 4, 1, 2)]
    assert uploads == [True, True, True, False, True, False, True]


def test_pinned_waveforms_are_never_evicted():
    cache = SlotCache(4, same)
    cache.pin([7])
    assert put(cache, 7)
    for key in range(100, 150):
        put(cache, key)
    assert not put(cache, 7)


def test_at_least_min_unpinned_slots_stay_unpinned():
    cache = SlotCache(4, same)
    cache.pin(range(10))
    for key in range(10):
        put(cache, key)
    assert [key for key in range(10) if cache.find(key) is not None][: 4 - MIN_UNPINNED] == [0, 1]
    assert put(cache, 99)


def test_all_pinned_of_too_few_slots_still_plays():
    cache = SlotCache(1, same)
    cache.pin([1])
    assert [put(cache, key) for key in (1, 2, 1)] == [True, True, True]


def test_a_resident_waveform_of_a_nearby_place_is_reused():
    cache = SlotCache(4, lambda key: (key // 10 * 1e-3, 0.0, key % 10), near_m=2e-3)  # tens: place in mm, ones: amplitude
    put(cache, 100)
    assert cache.find(120) == 100
    assert cache.find(130) is None, "too far"
    assert cache.find(121) is None, "weaker"
    for key in (500, 600, 700, 800):
        put(cache, key)
    assert cache.find(120) is None, "its slot was given away"


def test_a_slot_whose_upload_was_refused_is_the_next_to_be_used():
    cache = SlotCache(3, same)
    put(cache, 1)
    assert cache.take() == cache.take()


def test_a_slot_that_is_spared_is_taken_only_if_it_is_the_only_one():
    cache = SlotCache(2, same)
    put(cache, 1)
    put(cache, 2)
    assert cache.take(spared=cache.use(1)) == cache.take(spared=cache.use(1))
    assert cache.find(1) == 1
    assert SlotCache(1, same).take(spared=0) == 0


def test_a_waveform_kept_in_another_slot_leaves_the_former():
    cache = SlotCache(3, same)
    put(cache, 1)
    before = cache.use(1)
    slot = cache.take(spared=before)
    cache.keep(1, slot)
    assert cache.use(1) == slot
    assert [key for _, key in cache.held.items()] == [None, None, 1]
    assert cache.take() == before


def test_no_waveform_counts_as_resident_after_a_fault():
    cache = SlotCache(3, same)
    put(cache, 1)
    cache.clear()
    assert put(cache, 1)


@given(
    st.integers(1, 16),
    st.sets(st.integers(0, 30), max_size=5),
    st.lists(st.tuples(st.sampled_from(["play", "ahead", "refused", "damaged", "again", "clear"]), st.integers(0, 30))),
)
def test_every_slot_is_used_by_one_waveform_at_most(slots, pinned, steps):
    """Tens of a key: its place in mm; so that ten of them serve for each other."""
    cache = SlotCache(slots, lambda key: (key // 10 * 1e-2, 0.0, 0), near_m=1e-3)
    cache.pin(sorted(pinned))
    holds, latest = {}, None
    for what, key in steps:
        resident = cache.find(key)
        if what == "clear":
            cache.clear()
            holds.clear()
        elif resident is not None and what != "again":
            slot = cache.use(resident)
            assert holds[slot] == resident
            assert resident // 10 == key // 10
            if what == "damaged":
                cache.drop(slot)
                del holds[slot]
            latest = slot
        else:
            slot = cache.take(latest if what == "ahead" else None)
            assert slot != latest or what != "ahead" or slots == 1
            holds.pop(slot, None)
            if what != "refused":
                cache.keep(key, slot)
                holds = {other: held for other, held in holds.items() if held != key} | {slot: key}
        assert {slot: held for slot, held in cache.held.items() if held is not None} == holds
        assert sorted(slot for slot, _ in cache.held.items()) == list(range(slots))
        assert all(cache.find(held) == held for held in holds.values())
