# Languages.

# The language's own name.
language-name = English

# The number of test scenes.
test-scenes = { NUMBER($count) ->
    [one] { $count } test scene
   *[other] { $count } test scenes
}
