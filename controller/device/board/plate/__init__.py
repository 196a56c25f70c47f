"""What a plate is made of, how it is held and damped, and the piezo discs on it."""
