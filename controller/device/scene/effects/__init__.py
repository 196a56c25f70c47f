"""How an effect is written: its keys, those that go together, rhythms, trains of pulses, the library, and what a client sends."""
