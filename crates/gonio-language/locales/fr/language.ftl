# Languages.

# The language's own name.
language-name = français

# The number of test scenes.
test-scenes = { NUMBER($count) ->
    [one] { $count } scène de test
   *[other] { $count } scènes de test
}
