"""The panel as a service: drivers, systemd, log and temperature, another scene, and the doctor."""
