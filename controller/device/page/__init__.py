"""A bridge between browsers and the application socket, `haptic.js`, and a page to look at: a process of its own."""
