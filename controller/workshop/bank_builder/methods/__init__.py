"""Methods that find drive words from the plate model, for a bank or a benchmark; nothing here runs on the device."""
