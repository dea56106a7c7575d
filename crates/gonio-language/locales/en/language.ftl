# Languages.

# The language's own name.
language-name = English
