"""Full solutions of line contacts: how far published laws are from them, and their friction as a law for one oil."""
