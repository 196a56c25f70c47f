"""What production makes of a panel: plates drawn from tolerances, and what banks play on them."""
