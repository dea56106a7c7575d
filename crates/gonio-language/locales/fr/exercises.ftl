# exercises

## exercise/compiler

exercise-not-drawn = Rien n'est dessiné : { $found }
exercise-this-shader-is-not-drawn-because = Rien n'est dessiné avec ce shader, car il n'a pas pu être testé : { $reason }
exercise-nothing-is-drawn-no-attribute-was = Rien n'est dessiné : aucun attribut n'a été reconnu comme la position. Nommez-le `position`, ou déclarez-le dans names.toml

## exercise/drafts

exercise-the-draft-of-is-damaged-and = le brouillon de { $name } est endommagé et n'a pas été restauré : { $error }
exercise-the-unsaved-changes-to-could-not = les modifications non enregistrées de { $name } n'ont pas pu être conservées comme brouillon : { $error } ; Ctrl + S enregistre le fichier
exercise-the-file-is-larger-than-mb = le fichier dépasse { $megabytes } Mo
exercise-less-than-a-minute-ago = il y a moins d'une minute
exercise-minutes-ago = { NUMBER($count) ->
    [one] il y a { $count } minute
    *[other] il y a { $count } minutes
    }
exercise-hours-ago = { NUMBER($count) ->
    [one] il y a { $count } heure
    *[other] il y a { $count } heures
    }
exercise-days-ago = { NUMBER($count) ->
    [one] il y a { $count } jour
    *[other] il y a { $count } jours
    }

## exercise/editor

exercise-the-exercise-has-no-files-to = L'exercice n'a aucun fichier à modifier : déposez les vôtres ici.
exercise-this-file-is-not-utf = Ce fichier n'est pas du texte UTF-8 : il peut servir à dessiner et être vérifié, mais pas être modifié
exercise-in-memory-only-ctrl-s-saves = En mémoire seulement ; Ctrl + S l'enregistre
exercise-restored-unsaved-changes-from-in-they = Les modifications non enregistrées faites { $age } dans { $names } ont été restaurées. Elles ne sont pas encore enregistrées.
exercise-discard = Rejeter
exercise-keep = Garder
exercise-restored-unsaved-changes-from-in-but = Les modifications non enregistrées faites { $age } dans { $name } ont été restaurées, mais { $name } a changé sur le disque depuis. Les deux versions sont conservées jusqu'à ce que vous en choisissiez une.
exercise-has-changed-on-disk-and-you = { $name } a changé sur le disque, et vous avez ici des modifications non enregistrées.
exercise-load-the-version-on-disk = Charger la version du disque
exercise-keep-mine-and-save-it = Enregistrer ma version
exercise-replaced = Remplacé : { $files }.
exercise-replaced-unsaved = Remplacé : { $files } (modifications non enregistrées).
exercise-restore = Restaurer
exercise-switch-back-to-the-files-that = Revenir aux fichiers ouverts auparavant ; ceux-ci pourront être restaurés de la même façon

## exercise/file_sets

exercise-opened = ouvert : { $names }
exercise-opened-in-place = ouvert : { $names }, à la place de { $others }
exercise-and = { $names } et { $last }
exercise-and-more = { $names } et { NUMBER($count) ->
    [one] { $count } autre
    *[other] { $count } autres
    }

## exercise/fix

exercise-apply = Appliquer
exercise-change-the-text-in-the-editor = Modifier le texte dans l'éditeur ; Ctrl + Z annule la modification

## exercise/lamp

exercise-lamp = Lampe
exercise-the-lamp-drag-it-reset-the = La lampe : faites-la glisser. `Réinitialiser la caméra` la remet aussi en place

## exercise/list

exercise-exercises = Exercices
exercise-edit-shaders-compare-them-live-with = Modifiez des shaders, comparez-les en direct à la réponse juste et laissez gonio trouver les erreurs : leur nom, leur ligne et comment les corriger.
exercise-does-not-compile = ne compile pas
exercise-not-judged = non jugé
exercise-in-progress = en cours
exercise-not-started = non commencé
exercise-unsaved-changes = { $word }, modifications non enregistrées

## exercise/mod

exercise-unknown-exercise-select-one-from-the = exercice inconnu `{ $exercise }` : choisissez-en un dans la liste
exercise-select-the-exercise-first-then-open = choisissez d'abord l'exercice, puis rouvrez ses fichiers
exercise-files = Fichiers
exercise-exercise = Énoncé
exercise-verdict = Verdict
exercise-variables = Variables
exercise-start-over-with-the-original-files = Recommencer avec les fichiers d'origine ; ceux qui sont ouverts pourront être restaurés
exercise-start-over = Recommencer
exercise-download-zip = Télécharger { $id }.zip
exercise-the-text-its-figures-and-the = L'énoncé, ses figures et les fichiers d'origine

## exercise/pages

exercise-also-accept-the-ways-of-the = Accepter aussi les méthodes des solutions du TP là où elles s'écartent des manuels
exercise-accept-the-lab-s-shortcuts = Accepter les raccourcis du TP
exercise-check = Vérifier
exercise-checking = Vérification...
exercise-tells-which-are-right = indique ce qui est juste.
exercise-names-each-mistake = nomme chaque erreur.
exercise-reports-each-mistake-by-name-and-2 = signale chaque erreur par son nom et sa ligne, avec ce qu'il faut y écrire.
exercise-reports-each-mistake-by-name-and = signale chaque erreur par son nom et sa ligne, avec une correction.
exercise-compares-your-picture-with-the-right = compare votre image à l'image juste pour vos coordonnées de texture
exercise-draws-your-program-in-test-scenes = dessine avec votre programme des scènes de test qui révèlent les erreurs
exercise-not-checked-yet-the-check-and = Pas encore vérifié. La vérification { $way }, et { $hint }
exercise-the-files-have-changed-since-this = Les fichiers ont changé depuis cette vérification.
exercise-correct-but-worth-knowing = Juste, mais bon à savoir
exercise-warnings = Avertissements
exercise-correct = Juste
exercise-wrong = Faux
exercise-does-not-compile-2 = Ne compile pas
exercise-not-judged-2 = Non jugé
exercise-the-result-differs-from-the-correct = Le résultat diffère du résultat juste.
exercise-of-test-scenes-differ-from-the = { NUMBER($wrong) ->
    [one] { $wrong } scène de test sur { $all } diffère de l'image juste.
    *[other] { $wrong } scènes de test sur { $all } diffèrent de l'image juste.
    }
exercise-what-can-be-seen-in-the = Ce qui se voit sur l'image
exercise-the-mistakes-by-name = Les erreurs par leur nom
exercise-the-line-of-each-mistake-also = La ligne de chaque erreur, marquée aussi dans l'éditeur
exercise-how-to-fix-each-mistake = Comment corriger chaque erreur
exercise-show-up-to-the = Montrer jusqu'à :
exercise-the-picture-differs-from-the-correct = L'image diffère de l'image juste.
exercise-it-explains-of-the-difference = Elle explique { $share } % de la différence.
exercise-it-does-not-change-the-pictures = Elle ne change pas les images des scènes de test.
exercise-found-in-the-source = Trouvée dans le code source.
exercise-symptom = Symptôme :
exercise-how-to-fix-it = Comment la corriger :
exercise-same-picture-as = Même image que :
exercise-the-lab-s-own-solution-does = La solution du TP fait la même chose ; `Accepter les raccourcis du TP` la laisse passer.
exercise-taught-in = Dans le cours : « { $lecture_section } »
exercise-terms = Termes
exercise-not-tested-separately = non testé séparément
exercise-test-scenes = Scènes de test
exercise-show-the-pictures-of-this-scene = Afficher les images de cette scène
exercise-of-pixels-differ = { $pixels_beyond } des pixels diffèrent
exercise-less-than-1 = moins de 1 %
exercise-once-your-program-compiles-this-page = Dès que votre programme compile, cette page donne la signification et la valeur de chacun de vos attributs et uniforms.
exercise-not-recognised-and-set-to-0 = { NUMBER($count) ->
    [one] Une variable n'est pas reconnue et vaut 0. Ignorez ce message pour les variables dont vous n'avez pas besoin. Sinon, déclarez leur signification dans un fichier names.toml :
    *[other] Des variables ne sont pas reconnues et valent 0. Ignorez ce message pour les variables dont vous n'avez pas besoin. Sinon, déclarez leur signification dans un fichier names.toml :
    }
exercise-not-recognised = non reconnue

## exercise/picture_files

exercise-decoded-picture = image décodée

## exercise/pictures

exercise-nothing-is-drawn-because-opengl-is = Rien n'est dessiné, car OpenGL n'est pas disponible.
exercise-testing-the-new-program-in-a = Test du nouveau programme dans un processus séparé avant de dessiner
exercise-showing-the-last-program-that-compiled = Affichage du dernier programme qui a compilé
exercise-older-program = programme plus ancien
exercise-yours = Votre image
exercise-reference = Référence
exercise-difference = Différence
exercise-your-program-is-not-drawn-the = Rien n'est dessiné avec votre programme ; la raison est indiquée sous l'éditeur.
exercise-your-program-does-not-compile-the = Votre programme ne compile pas ; les erreurs sont indiquées sous l'éditeur.
exercise-this-exercise-has-no-reference-picture = Cet exercice n'a pas d'image de référence.
exercise-the-difference-is-shown-once-your = La différence s'affiche dès que votre programme compile.
exercise-write-a-program-in-any-language = Écrivez, dans le langage de votre choix, un programme qui produit un tampon de sommets en .csv, en .json ou en flottants bruts (.bin). Déposez ce fichier ici et cliquez sur Vérifier pour voir quels triangles sont faux, et pourquoi.
exercise-this-exercise-is-a-list-of = Cet exercice est une liste d'appels OpenGL. Corrigez-la et cliquez sur Vérifier : gonio l'exécute appel par appel. En ligne de commande : `gonio lab check ex11 FILE.txt`.
exercise-bake-the-model-in-blender-or = Précalculez la texture du modèle, dans Blender ou avec `gonio bake`. Déposez ici les fichiers du dossier (.obj, .mtl et .png, ou .glb) et cliquez sur Vérifier pour voir quelles parties ont les bonnes couleurs.
exercise-the-answer-is-six-cube-faces = La réponse est formée des six faces d'une cubemap. Écrivez le shader qui les dessine, ou déposez les six images produites par votre propre programme, puis cliquez sur Vérifier.
exercise-the-picture-of-your-program = L'image de votre programme
exercise-the-picture-of-the-correct-answer = L'image de la réponse juste
exercise-both-side-by-side = Les deux côte à côte
exercise-the-difference-dark-where-they-agree = La différence : sombre là où elles concordent
exercise-picture = Image
exercise-scene = Scène
exercise-pause = Pause
exercise-play = Lecture
exercise-reset-the-camera = Réinitialiser la caméra
exercise-show-each-line-s-values-at = Afficher les valeurs de chaque ligne en un pixel : cliquez sur l'image, ou sur ce bouton pour le pixel du milieu (F9)

## exercise/saving

exercise-already-exists-choose-another-folder = { $name } existe déjà : choisissez un autre dossier
exercise-could-not-be-created = { $folder } n'a pas pu être créé : { $error }
exercise-could-not-be-reloaded = { $path } n'a pas pu être rechargé : { $error }

## exercise/toolbar

exercise-back-to-the-scene = Revenir à la scène
exercise-select-another-exercise = Choisir un autre exercice
exercise-light-or-dark-theme = Thème clair ou sombre
exercise-stop = Arrêter
exercise-stop-the-check-esc = Arrêter la vérification (Esc)
exercise-check-ctrl-enter = Vérifier  Ctrl+Enter
exercise-find-mistakes-by-name-and-line = Trouver les erreurs, avec leur nom et leur ligne (Ctrl + Enter)
exercise-open-your-own-files-in-place = Ouvrir vos propres fichiers à la place de ceux-ci (Ctrl + O), ou les déposer ici
exercise-save-the-files-ctrl-s = Enregistrer les fichiers (Ctrl + S)
exercise-undo-in-this-file-ctrl-z = Annuler dans ce fichier (Ctrl + Z)
exercise-redo-in-this-file-ctrl-y = Rétablir dans ce fichier (Ctrl + Y)
exercise-find-in-this-file-ctrl-f = Rechercher dans ce fichier (Ctrl + F)
exercise-save-to-a-folder = Enregistrer dans un dossier
exercise-the-folder-is-created-if-it = Le dossier est créé s'il n'existe pas. Vous pouvez ensuite modifier les fichiers dans n'importe quel éditeur.
exercise-folder = Dossier
exercise-save = Enregistrer

## exercise/work

exercise-bytes-of-binary-data = { NUMBER($count) ->
    [one] { $count } octet de données binaires.
    *[other] { $count } octets de données binaires.
    }

## step/bar

exercise-remove-the-pin-and-the-values = Retirer l'épingle et les valeurs (F9)
exercise-pixel-2 = Pixel
exercise-pixel = Pixel { $x }, { $y }
exercise-the-fragment-shader-at-this-pixel = Le fragment shader en ce pixel
exercise-the-vertex-shader-at-a-corner = Le vertex shader à un coin du triangle en ce pixel
exercise-shader = Shader
exercise-vertex-with-a-weight-of-at = Sommet { $vertex }, de poids { $weight } en ce pixel
exercise-corner-1 = coin 1
exercise-corner-2 = coin 2
exercise-corner-3 = coin 3
exercise-corner = Coin
exercise-first-step = Premier pas
exercise-back-over-calls-shift-f10-alt = Pas précédent, sans entrer dans les appels (Shift + F10, Alt + Up)
exercise-next-step-over-calls-f10-alt = Pas suivant, sans entrer dans les appels (F10, Alt + Down)
exercise-back-into-calls-shift-f11-alt = Pas précédent, en entrant dans les appels (Shift + F11, Alt + Left)
exercise-next-step-into-calls-f11-alt = Pas suivant, en entrant dans les appels (F11, Alt + Right)
exercise-step = Pas
exercise-value-and-picture-of-the-expression = Valeur et image de l'expression au curseur (Alt + Enter) ; le pointeur de la souris les montre aussi
exercise-no-statement-was-executed = Aucune instruction n'a été exécutée.
exercise-step-of-line-in = Pas { $at } sur { $count } : ligne { $line } dans { $function }
exercise-called-at-line = , appel à la ligne { $and }
exercise-and-2 = {" "}puis à la ligne{" "}
exercise-iteration = , itération { $it }
exercise-within-it = , et dans celle-ci itération{" "}
exercise-first-nan-or-infinity-line = Premier NaN ou infini, ligne { $line } : { $expression } = { $value }
exercise-never-written-before-it-is-read = Valeur lue sans avoir jamais été écrite, ligne { $line } : { $expression }
exercise-the-loop-at-line-does-not = La boucle de la ligne { $line } ne se termine pas : arrêt après { $statements } instructions
exercise-line-discards-this-pixel = La ligne { $line } rejette ce pixel
exercise-go-to-this-step = Aller à ce pas

## step/code

exercise-line = Ligne { $line } : { $text }
exercise-and-more-2 = et { NUMBER($count) ->
    [one] { $count } autre
    *[other] { $count } autres
    }

## step/find

exercise-search-field = champ de recherche
exercise-find = Rechercher
exercise-not-found = introuvable
exercise-of = { $number } sur { $count }
exercise-matches = Occurrences
exercise-previous-match-shift-f3 = Occurrence précédente (Shift + F3)
exercise-next-match-f3 = Occurrence suivante (F3)
exercise-close-the-search-esc = Fermer la recherche (Esc)

## step/margin

exercise-there-is-no-picture = Il n'y a pas d'image.
exercise-the-vertex-shader-does-not-end = Le vertex shader ne se termine pas pour le sommet { $vertex } : rien n'est donc dessiné.
exercise-nothing-is-drawn-at-this-pixel = Rien n'est dessiné en ce pixel : cliquez sur un objet.
exercise-that-of-this-step = celle de ce pas
exercise-the-last = la dernière
exercise-of-values = { $which }, sur { $count } valeurs
exercise-not-evaluated-here = Non évaluée ici.
exercise-the-last-of-up-to-values = {" "}; la dernière valeur de chaque pixel, sur { $evaluations } au plus
exercise-magenta-not-a-finite-number = magenta : nombre non fini
exercise-cyan-never-written = cyan : jamais écrit
exercise-chequered-not-evaluated = damier : non évalué

## step/mod

exercise-the-values-are-shown-once-your = Les valeurs s'affichent dès que votre programme compile.
exercise-the-values-could-not-be-computed = Les valeurs n'ont pas pu être calculées : l'interpréteur s'est arrêté de façon inattendue.

## step/values

exercise-times = {"   "}({ $count } fois)
exercise-is = { $expression } vaut { $holds }
exercise-the-last-of-times-so-far = La dernière des { $count } fois jusqu'ici.
exercise-never-written = jamais écrit

## short words

exercise-correct-state = juste
exercise-wrong-state = faux
exercise-nothing = rien
exercise-later-steps-are-not-shown = {" "}; les pas suivants ne sont pas affichés
exercise-before = avant : { $value }
exercise-interpolated-between-the-vertices = {" "}; interpolé entre les sommets
exercise-test = test : { $scene }
