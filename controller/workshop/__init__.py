"""What any computer may do for a panel: models, banks, calibration, gateware, releases, figures."""
