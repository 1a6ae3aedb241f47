"""The local page in the browser: recordings, surfaces and pairings, and the same answers from REST."""
