"""Every number that decides an outcome of the diagnosis, with its reason and what kind of reason that is.

Definition: follows from what the name means. Source: taken from the literature. Measured: by the test that is named.
Grid: values that are tried, of which the readings choose. Cost limit: more would cost time and change answers little.
Judgement: chosen by the authors; another choice near it would be as defensible.
"""
