"""Several FPGAs that play as one."""
