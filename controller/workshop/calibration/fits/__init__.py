"""What measured responses say of the plate and its stages: decay, drift with temperature, bit clock, R C."""
