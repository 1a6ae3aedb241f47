"""Files of the foreign package are for the programs that the tests start, and not read here."""

collect_ignore = ["foreign"]
