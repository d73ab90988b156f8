"""One end of a PRIAMOS radio link in Python: see README.md beside this folder."""
