"""Full solutions of line contacts: errors of published laws, and friction laws for single oils."""
