"""Which tests of a machine the slow form alone runs."""


def slow(test):
    """Leave a test to `pytest -m slow`: it takes minutes, and what it shows is shown in less detail without it."""
    test.slow = True
    return test
