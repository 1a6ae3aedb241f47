"""Friction of full solutions condensed into a regression for one oil, which studies use as a friction law."""
