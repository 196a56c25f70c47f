"""A limit of rate with a burst."""

from __future__ import annotations


class TokenBucket:
    """Tokens that come at a constant rate in the long run; at most `burst` can be taken at once."""

    def __init__(self, rate_hz: float, burst: int) -> None:
        self._rate_hz = rate_hz
        self._burst = float(burst)
        self._tokens = 0.0
        self._filled_s = 0.0

    def fill(self, now_s: float) -> None:
        """It is full."""
        self._tokens, self._filled_s = self._burst, now_s

    def take(self, now_s: float, tokens: int = 1) -> bool:
        """Take tokens, never more than the burst; False, and none is taken, if there are not as many."""
        self._tokens = min(self._tokens + (now_s - self._filled_s) * self._rate_hz, self._burst)
        self._filled_s = now_s
        wanted = min(float(tokens), self._burst)
        if self._tokens < wanted:
            return False
        self._tokens -= wanted
        return True
