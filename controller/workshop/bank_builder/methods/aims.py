"""What an entry of a bank is optimised for by `descent`: what `--optimise` may name."""

from dataclasses import dataclass


@dataclass(frozen=True)
class DescentAim:
    """What a waveform is optimised for."""

    name: str
    # contrast, silence, calm: costs of the mean square field outside the focus (0: it is left alone, which saves most of the
    # time), of the audible energy and of the edges of all channels, each relative to that of the plain waveform, where the
    # plain waveform's amplitude is worth about `amplitude`
    contrast: float
    silence: float
    calm: float
    amplitude: float  # worth of the amplitude that the relaxation begins with
    steps: int  # of the relaxation
    passes: int = 1  # of the descent
    share: float = 1.0  # of the plain amplitude, that the relaxation aims at
    felt_turns: int = 0  # of relaxation, rounding and descent for the felt amplitude, its derivative computed again before each


AIMS = {
    aim.name: aim
    for aim in (
        DescentAim("contrast", contrast=0.1, silence=0.05, calm=0.05, amplitude=0.12, steps=40),
        DescentAim("quiet", contrast=0.0, silence=2.0, calm=0.2, amplitude=0.25, steps=250),
        DescentAim("balanced", contrast=0.1, silence=0.6, calm=0.15, amplitude=0.35, steps=80),
        DescentAim("loud", contrast=0.0, silence=0.5, calm=0.1, amplitude=1.5, steps=100, share=1.2),
        DescentAim("cool", contrast=0.0, silence=0.004, calm=1.4, amplitude=0.6, steps=20, passes=3, share=0.95),
        DescentAim("felt", contrast=0.0, silence=0.5, calm=0.1, amplitude=1.5, steps=100, share=1.4, felt_turns=3),
    )
}
