"""What runs in every turn: what is due, what is played together, what each slot holds, whether the outputs are on."""
