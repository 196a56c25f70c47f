"""From measured points to every place of the plate: wavenumbers, errors of points, kriging, cosines, modes."""
