"""What runs in every turn: what is due, what is played as one waveform, what each slot holds, whether the outputs are on."""
