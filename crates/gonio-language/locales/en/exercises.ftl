# exercises

## exercise/compiler

exercise-not-drawn = Not drawn: { $found }
exercise-this-shader-is-not-drawn-because = This shader is not drawn because it could not be tested: { $reason }
exercise-nothing-is-drawn-no-attribute-was = Nothing is drawn: no attribute was recognised as the position. Name it `position`, or declare it in names.toml

## exercise/drafts

exercise-the-draft-of-is-damaged-and = the draft of { $name } is damaged and was not restored: { $error }
exercise-the-unsaved-changes-to-could-not = the unsaved changes to { $name } could not be kept as a draft: { $error }; Ctrl + S saves the file
exercise-the-file-is-larger-than-mb = the file is larger than { $megabytes } MB
exercise-less-than-a-minute-ago = less than a minute ago
exercise-minutes-ago = { NUMBER($count) ->
    [one] { $count } minute ago
   *[other] { $count } minutes ago
}
exercise-hours-ago = { NUMBER($count) ->
    [one] { $count } hour ago
   *[other] { $count } hours ago
}
exercise-days-ago = { NUMBER($count) ->
    [one] { $count } day ago
   *[other] { $count } days ago
}

## exercise/editor

exercise-the-exercise-has-no-files-to = The exercise has no files to edit: drop yours here.
exercise-this-file-is-not-utf = This file is not UTF-8 text: it can be drawn and checked, but not edited
exercise-in-memory-only-ctrl-s-saves = In memory only; Ctrl + S saves it
exercise-restored-unsaved-changes-from-in-they = Restored unsaved changes from { $age } in { $names }. They are not saved yet.
exercise-discard = Discard
exercise-keep = Keep
exercise-restored-unsaved-changes-from-in-but = Restored unsaved changes from { $age } in { $name }, but { $name } has changed on disk since then. Both versions are kept until you choose one.
exercise-has-changed-on-disk-and-you = { $name } has changed on disk, and you have unsaved changes here.
exercise-load-the-version-on-disk = Load the version on disk
exercise-keep-mine-and-save-it = Keep mine and save it
exercise-replaced = Replaced { $files }.
exercise-replaced-unsaved = Replaced { $files } (unsaved).
exercise-restore = Restore
exercise-switch-back-to-the-files-that = Switch back to the files that were open before; these can be restored in the same way

## exercise/file_sets

exercise-opened = opened { $names }
exercise-opened-in-place = opened { $names } in place of { $others }
exercise-and = { $names } and { $last }
exercise-and-more = { $names } and { $count } more

## exercise/fix

exercise-apply = Apply
exercise-change-the-text-in-the-editor = Change the text in the editor; Ctrl + Z undoes it

## exercise/lamp

exercise-lamp = Lamp
exercise-the-lamp-drag-it-reset-the = The lamp: drag it. `Reset the camera` also puts it back

## exercise/list

exercise-exercises = Exercises
exercise-edit-shaders-compare-them-live-with = Edit shaders, compare them live with the correct answer, and have gonio find the mistakes: by name, by line, and how to fix them.
exercise-does-not-compile = does not compile
exercise-not-judged = not judged
exercise-in-progress = in progress
exercise-not-started = not started
exercise-unsaved-changes = { $word }, unsaved changes

## exercise/mod

exercise-unknown-exercise-select-one-from-the = unknown exercise `{ $exercise }`: select one from the list
exercise-select-the-exercise-first-then-open = select the exercise first, then open its files again
exercise-files = Files
exercise-exercise = Exercise
exercise-verdict = Verdict
exercise-variables = Variables
exercise-start-over-with-the-original-files = Start over with the original files; the open ones can be put back
exercise-start-over = Start over
exercise-download-zip = Download { $id }.zip
exercise-the-text-its-figures-and-the = The text, its figures and the original files

## exercise/pages

exercise-also-accept-the-ways-of-the = Also accept the ways of the lab's own solutions where they differ from the textbook
exercise-accept-the-lab-s-shortcuts = Accept the lab's shortcuts
exercise-check = Check
exercise-checking = Checking...
exercise-tells-which-are-right = tells which are right.
exercise-names-each-mistake = names each mistake.
exercise-reports-each-mistake-by-name-and-2 = reports each mistake by name and line, with what belongs there.
exercise-reports-each-mistake-by-name-and = reports each mistake by name and line, with a fix.
exercise-compares-your-picture-with-the-right = compares your picture with the right one for your texture coordinates
exercise-draws-your-program-in-test-scenes = draws your program in test scenes that reveal mistakes
exercise-not-checked-yet-the-check-and = Not checked yet. The check { $way }, and { $hint }
exercise-the-files-have-changed-since-this = The files have changed since this check.
exercise-correct-but-worth-knowing = Correct, but worth knowing
exercise-warnings = Warnings
exercise-correct = Correct
exercise-wrong = Wrong
exercise-does-not-compile-2 = Does not compile
exercise-not-judged-2 = Not judged
exercise-the-result-differs-from-the-correct = The result differs from the correct one.
exercise-of-test-scenes-differ-from-the = { $wrong } of { $all } test scenes differ from the correct picture.
exercise-what-can-be-seen-in-the = What can be seen in the picture
exercise-the-mistakes-by-name = The mistakes by name
exercise-the-line-of-each-mistake-also = The line of each mistake, also marked in the editor
exercise-how-to-fix-each-mistake = How to fix each mistake
exercise-show-up-to-the = Show up to the
exercise-the-picture-differs-from-the-correct = The picture differs from the correct one.
exercise-it-explains-of-the-difference = It explains { $share } % of the difference.
exercise-it-does-not-change-the-pictures = It does not change the pictures of the test scenes.
exercise-found-in-the-source = Found in the source.
exercise-symptom = Symptom:
exercise-how-to-fix-it = How to fix it:
exercise-same-picture-as = Same picture as:
exercise-the-lab-s-own-solution-does = The lab's own solution does the same; `Accept the lab's shortcuts` passes it.
exercise-taught-in = Taught in: { $lecture_section }
exercise-terms = Terms
exercise-not-tested-separately = not tested separately
exercise-test-scenes = Test scenes
exercise-show-the-pictures-of-this-scene = Show the pictures of this scene
exercise-of-pixels-differ = { $pixels_beyond } of pixels differ
exercise-less-than-1 = less than 1 %
exercise-once-your-program-compiles-this-page = Once your program compiles, this page lists the meaning and the value of each of your attributes and uniforms.
exercise-not-recognised-and-set-to-0 = { NUMBER($count) ->
    [one] One variable is not recognised, and set to 0. Ignore this for variables that you do not need. Otherwise declare their meaning in a file names.toml:
   *[other] Some variables are not recognised, and set to 0. Ignore this for variables that you do not need. Otherwise declare their meaning in a file names.toml:
}
exercise-not-recognised = not recognised

## exercise/picture_files

exercise-decoded-picture = decoded picture

## exercise/pictures

exercise-nothing-is-drawn-because-opengl-is = Nothing is drawn because OpenGL is not available.
exercise-testing-the-new-program-in-a = Testing the new program in a separate process before drawing it
exercise-showing-the-last-program-that-compiled = Showing the last program that compiled
exercise-older-program = older program
exercise-yours = Yours
exercise-reference = Reference
exercise-difference = Difference
exercise-your-program-is-not-drawn-the = Your program is not drawn; the reason is below the editor.
exercise-your-program-does-not-compile-the = Your program does not compile; the errors are below the editor.
exercise-this-exercise-has-no-reference-picture = This exercise has no reference picture.
exercise-the-difference-is-shown-once-your = The difference is shown once your program compiles.
exercise-write-a-program-in-any-language = Write a program in any language that outputs a vertex buffer as .csv, .json or raw floats (.bin). Drop that file here and press Check to see which triangles are wrong, and why.
exercise-this-exercise-is-a-list-of = This exercise is a list of OpenGL calls. Fix it and press Check: gonio executes it call by call. On the command line: `gonio lab check ex11 FILE.txt`.
exercise-bake-the-model-in-blender-or = Bake the model, in Blender or with `gonio bake`. Drop the folder's files here (.obj, .mtl and .png, or .glb) and press Check to see which parts have the right colours.
exercise-the-answer-is-six-cube-faces = The answer is six cube faces. Write the shader that draws them, or drop the six pictures that your own program made, and press Check.
exercise-the-picture-of-your-program = The picture of your program
exercise-the-picture-of-the-correct-answer = The picture of the correct answer
exercise-both-side-by-side = Both side by side
exercise-the-difference-dark-where-they-agree = The difference: dark where they agree
exercise-picture = Picture
exercise-scene = Scene
exercise-pause = Pause
exercise-play = Play
exercise-reset-the-camera = Reset the camera
exercise-show-each-line-s-values-at = Show each line's values at a pixel: click on the picture, or press this for its middle (F9)

## exercise/saving

exercise-already-exists-choose-another-folder = { $name } already exists: choose another folder
exercise-could-not-be-created = { $folder } could not be created: { $error }
exercise-could-not-be-reloaded = { $path } could not be reloaded: { $error }

## exercise/toolbar

exercise-back-to-the-scene = Back to the scene
exercise-select-another-exercise = Select another exercise
exercise-light-or-dark-theme = Light or dark theme
exercise-stop = Stop
exercise-stop-the-check-esc = Stop the check (Esc)
exercise-check-ctrl-enter = Check  Ctrl+Enter
exercise-find-mistakes-by-name-and-line = Find mistakes by name and line (Ctrl + Enter)
exercise-open-your-own-files-in-place = Open your own files in place of these (Ctrl + O), or drop them here
exercise-save-the-files-ctrl-s = Save the files (Ctrl + S)
exercise-undo-in-this-file-ctrl-z = Undo in this file (Ctrl + Z)
exercise-redo-in-this-file-ctrl-y = Redo in this file (Ctrl + Y)
exercise-find-in-this-file-ctrl-f = Find in this file (Ctrl + F)
exercise-save-to-a-folder = Save to a folder
exercise-the-folder-is-created-if-it = The folder is created if it does not exist. You can then edit the files in any editor.
exercise-folder = Folder
exercise-save = Save

## exercise/work

exercise-bytes-of-binary-data = { $count } bytes of binary data.

## step/bar

exercise-remove-the-pin-and-the-values = Remove the pin and the values (F9)
exercise-pixel-2 = Pixel
exercise-pixel = Pixel { $x }, { $y }
exercise-the-fragment-shader-at-this-pixel = The fragment shader at this pixel
exercise-the-vertex-shader-at-a-corner = The vertex shader at a corner of the triangle at this pixel
exercise-shader = Shader
exercise-vertex-with-a-weight-of-at = Vertex { $vertex }, with a weight of { $weight } at this pixel
exercise-corner-1 = corner 1
exercise-corner-2 = corner 2
exercise-corner-3 = corner 3
exercise-corner = Corner
exercise-first-step = First step
exercise-back-over-calls-shift-f10-alt = Back, over calls (Shift + F10, Alt + Up)
exercise-next-step-over-calls-f10-alt = Next step, over calls (F10, Alt + Down)
exercise-back-into-calls-shift-f11-alt = Back, into calls (Shift + F11, Alt + Left)
exercise-next-step-into-calls-f11-alt = Next step, into calls (F11, Alt + Right)
exercise-step = Step
exercise-value-and-picture-of-the-expression = Value and picture of the expression at the cursor (Alt + Enter); the pointer shows them too
exercise-no-statement-was-executed = No statement was executed.
exercise-step-of-line-in = Step { $at } of { $count }: line { $line } in { $function }
exercise-called-at-line = , called at line { $and }
exercise-and-2 = {" "}and{" "}
exercise-iteration = , iteration { $it }
exercise-within-it = , within it{" "}
exercise-first-nan-or-infinity-line = First NaN or infinity, line { $line }: { $expression } = { $value }
exercise-never-written-before-it-is-read = Never written before it is read, line { $line }: { $expression }
exercise-the-loop-at-line-does-not = The loop at line { $line } does not end: stopped after { $statements } statements
exercise-line-discards-this-pixel = Line { $line } discards this pixel
exercise-go-to-this-step = Go to this step

## step/code

exercise-line = Line { $line }: { $text }
exercise-and-more-2 = and { $count } more

## step/find

exercise-search-field = search field
exercise-find = Find
exercise-not-found = not found
exercise-of = { $number } of { $count }
exercise-matches = Matches
exercise-previous-match-shift-f3 = Previous match (Shift + F3)
exercise-next-match-f3 = Next match (F3)
exercise-close-the-search-esc = Close the search (Esc)

## step/margin

exercise-there-is-no-picture = There is no picture.
exercise-the-vertex-shader-does-not-end = The vertex shader does not end at vertex { $vertex }, so nothing is drawn.
exercise-nothing-is-drawn-at-this-pixel = Nothing is drawn at this pixel: click on an object.
exercise-that-of-this-step = that of this step
exercise-the-last = the last
exercise-of-values = { $which }, of { $count } values
exercise-not-evaluated-here = Not evaluated here.
exercise-the-last-of-up-to-values = ; the last of up to { $evaluations } values of a pixel
exercise-magenta-not-a-finite-number = magenta: not a finite number
exercise-cyan-never-written = cyan: never written
exercise-chequered-not-evaluated = chequered: not evaluated

## step/mod

exercise-the-values-are-shown-once-your = The values are shown once your program compiles.
exercise-the-values-could-not-be-computed = The values could not be computed: the interpreter ended unexpectedly.

## step/values

exercise-times = {"   "}({ $count } times)
exercise-is = { $expression } is { $holds }
exercise-the-last-of-times-so-far = The last of { $count } times so far.
exercise-never-written = never written

## short words

exercise-correct-state = correct
exercise-wrong-state = wrong
exercise-nothing = nothing
exercise-later-steps-are-not-shown = ; later steps are not shown
exercise-before = before: { $value }
exercise-interpolated-between-the-vertices = ; interpolated between the vertices
exercise-test = test: { $scene }
