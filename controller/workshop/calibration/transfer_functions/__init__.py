"""Records to transfer functions of each point: deconvolution, the recorder's clock, the direct waves to compare them with."""
