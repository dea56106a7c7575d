# window

## app/actions

window-there-is-no-picture-yet-wait = il n'y a pas encore d'image : attendez que la scène soit chargée
window-copied-the-link = lien copié
window-undone = Annulé : { $step }
window-redone = Rétabli : { $step }
window-overlays-are-not-drawn-over-a = les superpositions ne sont pas dessinées sur une image tracée ; appuyez sur Shift + T pour celle d'OpenGL
window-the-frame-cannot-be-recorded = la trame ne peut pas être capturée : { $error }
window-saved = enregistré : { $place }
window-captured = La capture est enregistrée : `qrenderdoc "{ $place }"` l'ouvre dans RenderDoc
window-copied-the-picture = image copiée

## app/baking

window-nothing-is-baked-yet-press-bake = rien n'est encore précalculé : lancez d'abord le précalcul
window-baking-was-cancelled = le précalcul a été annulé
window-baking-was-cancelled-because-another-scene = le précalcul a été annulé, car une autre scène a été ouverte
window-the-textures-are-baked = les textures sont précalculées

## app/exercise

window-close-again-to-discard-your-changes = Fermez de nouveau pour abandonner vos changements : { $error }
window-close-again-to-keep-them-as = Fermez de nouveau pour les garder comme brouillon, restauré quand vous rouvrirez ces fichiers
window-your-changes-to-are-not-saved = Vos changements dans { $id } ne sont pas enregistrés : Ctrl + S les enregistre. { $end }
window-your-changes-to-the-previous-files = Vos changements dans les fichiers précédents de { $id } ne sont pas enregistrés : `Restaurer` les ramène. { $end }
window-your-changes-to-the-scene-are = Vos changements dans la scène { $title } ne sont pas enregistrés : Ctrl + Shift + S les enregistre. { $end }
window-close-again-to-keep-the-scene = Fermez de nouveau pour les garder comme brouillon, proposé quand vous rouvrirez cette scène
window-unsaved-changes-were-kept = Des changements non enregistrés de { $title }, faits { $age }, ont été gardés
window-belongs-to-shaders-open-it-together = `{ $named }` fait partie de shaders : ouvrez-le avec eux
window-opened = ouvert : { $named }

## app/mod

window-opengl-rendering-is-not-available = le rendu OpenGL n'est pas disponible : { $error }
window-reading = lecture de { $inputs }
window-reloading = rechargement de { $changed }
window-reloaded = rechargé : { $title }
window-reloaded-the-changed-files = fichiers modifiés rechargés
window-reading-the-scene-s-files = lecture des fichiers de la scène

## app/unsaved

window-replaced-unsaved = { $title } remplacé (non enregistré)
window-restored = restauré : { $title }

## document/changes

window-added-a-pane = ajout d'une vue
window-removed-a-pane = suppression d'une vue
window-changed-the-arrangement-of-the-panes = changement de la disposition des vues
window-changed-what-a-pane-shows = changement du contenu d'une vue
window-changed-the-equation = changement de l'équation
window-changed-the-environment = changement de l'environnement
window-changed-the-background = changement de l'arrière-plan
window-changed-the-picture-s-settings = changement des réglages de l'image
window-moved-the-camera = déplacement de la caméra
window-switched-on = allumage de { $name }
window-switched-off = extinction de { $name }
window-light-number = lumière { $number }
window-object-number = objet { $number }
window-added = ajout de { $name }
window-removed = suppression de { $name }
window-moved = déplacement de { $name }
window-turned = rotation de { $name }
window-scaled = changement d'échelle de { $name }
window-renamed = changement de nom : { $name }
window-changed = changement de { $name }
window-changed-the-colour-of = changement de couleur de { $name }
window-changed-the-intensity-of = changement d'intensité de { $name }
window-changed-the-material-of = changement de matériau de { $name }

## document/pane

window-baked-picture = image précalculée
window-no-specular-term = sans terme spéculaire
window-spec-times-n-l = spec fois <N.L>
window-spec-without-n-l = spec sans <N.L>
window-of-light = { $quantity } de la lumière { $light }
window-as-in-the-scene = comme dans la scène
window-traced-with-all-simplifications = tracé avec toutes les simplifications
window-traced-up-to-step = tracé jusqu'à l'étape { $heading }
window-traced-simplified = tracé, simplifié : { $one }
window-traced-simplifications = tracé, { $count } simplifications
window-per-face = par face
window-of-the-triangles = { $share } % des triangles
window-triangles = { $triangles } triangles

## files/gathered

window-cannot-read-the-shader = impossible de lire le shader { $name } : { $error }
window-may-be-a-vertex-or-a = `{ $name }` peut être un vertex shader ou un fragment shader : nommez-le .vert ou .frag
window-and-are-both-shaders-open-one = `{ $other }` et `{ $name }` sont tous deux des { $stage } shaders : ouvrez un seul d'entre eux
window-a-model-obj-gltf-glb-dae = un modèle (.obj .gltf .glb .dae .ply .stl .mesh .meshb), une scène (.toml), des shaders (.vert .frag .glsl), un fichier zip qui les contient, ou une image comme environnement
window-no-files-to-open = aucun fichier à ouvrir
window-belongs-to-a-model-open-it = `{ $one }` fait partie d'un modèle : ouvrez-le avec le modèle
window-cannot-be-opened-expected = `{ $one }` ne peut pas être ouvert ; attendu : { $expected }
window-none-of-these-files-can-be = aucun de ces { $count } fichiers ne peut être ouvert ; attendu : { $expected }
window-the-six-faces-of-the-environment = les six faces de l'environnement n'ont pas été trouvées
window-these-pictures-are-not-one-environment = ces { $count } images ne forment pas un environnement : { $message }

## files/link

window-a-link-contains-the-scene-but = un lien contient la scène, mais pas ses fichiers tels que `{ $file }` : enregistrez la scène et envoyez le tout
window-the-scene-could-not-be-compressed = la scène n'a pas pu être compressée : { $error }
window-the-scene-in-the-link-is = la scène contenue dans le lien est endommagée : copiez le lien en entier

## files/memory

window-it-is-not-among-the-opened = il n'est pas parmi les fichiers ouverts ; ouvrez-le avec les autres

## files/mod

window-cannot-read = impossible de lire { $path } : { $error }
window-and-more = { NUMBER($count) ->
    [one] { $first } et { $count } autre
    *[other] { $first } et { $count } autres
}

## files/zip

window-the-zip-file-is-truncated-or-2 = le fichier zip est tronqué ou endommagé : son répertoire manque
window-zip64-files-are-not-supported-unpack = les fichiers Zip64 ne sont pas pris en charge : décompressez le fichier zip et ouvrez son contenu
window-the-zip-file-holds-files-more = le fichier zip contient { $count } fichiers, plus de { $most_files } : décompressez-le et n'ouvrez que ceux dont vous avez besoin
window-in-the-zip-file-is-encrypted = `{ $name }` dans le fichier zip est chiffré : décompressez le fichier zip et ouvrez son contenu
window-in-the-zip-file-is-larger = `{ $name }` dans le fichier zip dépasse { $most } Mio, la limite pour un fichier
window-the-zip-file-holds-more-than = le fichier zip contient plus de { $bytes } Mio : décompressez-le et ouvrez son contenu
window-in-the-zip-file-is-damaged-2 = `{ $name }` dans le fichier zip est endommagé : sa taille diffère de celle qu'indique le répertoire
window-in-the-zip-file-is-damaged = `{ $name }` dans le fichier zip est endommagé : créez de nouveau le fichier zip
window-in-the-zip-file-uses-an = `{ $name }` dans le fichier zip utilise une méthode de compression non prise en charge : utilisez Deflate ou aucune
window-the-zip-file-is-truncated-or = le fichier zip est tronqué ou endommagé : créez-le de nouveau

## missing_glyphs

window-more = { NUMBER($count) ->
    [one] { $count } autre
    *[other] { $count } autres
}
window-and = { $names } et { $last }
window-no-font-has-the-character-displayed = Aucune police n'a le caractère { $list }, affiché comme un carré : { $advice }
window-no-font-has-the-characters-displayed = Aucune police n'a les caractères { $list }, affichés comme des carrés : { $advice }

## panels/dialogs

window-keyboard-shortcuts = Raccourcis clavier
window-path-of-a-file-folder-or = Chemin d'un fichier, d'un dossier ou d'un fichier zip ; vous pouvez aussi déposer des fichiers sur la fenêtre
window-path-of-a-binary-merl-brdf = Chemin d'un fichier .binary (MERL), .brdf, .glsl ou .toml ; vous pouvez aussi déposer des fichiers sur la fenêtre
window-save-as = Enregistrer sous
window-path-of-the-file = Chemin du fichier
window-save = Enregistrer
window-path-of-a-model-scene-shader = Chemin d'un modèle, d'une scène, d'un shader, d'un fichier zip ou d'une image ; vous pouvez aussi déposer des fichiers sur la fenêtre
window-open = Ouvrir
window-cancel = Annuler

## panels/messages

window-messages-2 = { NUMBER($count) ->
    [one] { $file } : { $count } message
    *[other] { $file } : { $count } messages
}
window-messages = { NUMBER($count) ->
    [one] { $count } message
    *[other] { $count } messages
}
window-dismiss-all = Tout fermer
window-show-fewer = En voir moins
window-show-all = Tout voir
window-times = { $text } ({ $times } fois)
window-restore = Restaurer
window-discard = Abandonner
window-z-may-be-up = { $file } est un fichier STL : le plus souvent, z y pointe vers le haut, et non y comme dans cette scène.
window-turn-z-up = Mettre z vers le haut
window-dismiss = Fermer
window-copy-the-message = Copier le message

## panels/status

window-x-ms = { $width } x { $height } { $draw_ms } ms
window-triangles-samples = { $triangles } triangles  { $samples } échant.  { $time }
window-size-of-the-current-pane-and = Taille de la vue courante, et durée de la dernière trame terminée
window-files-and-megabytes = { NUMBER($count) ->
    [one] { $count } fichier, { $megabytes } Mo
    *[other] { $count } fichiers, { $megabytes } Mo
}
window-pause-space = Pause (Espace)
window-play-space = Lecture (Espace)
window-back-to-time-0 = Revenir au temps 0
window-time-within-the-longest-period-double = Temps dans la plus longue période. Double-clic : 0
window-of-s = { $within } sur { $period } s

## panels/top_bar

window-brdf-bench-reflection-functions-plotted-compared = Banc de BRDF : fonctions de réflexion représentées, comparées et vérifiées
window-beyond = Au-delà
window-beyond-the-rendering-equation-polarisation-interference = Au-delà de l'équation de rendu : polarisation, interférences, brouillard et sept autres phénomènes
window-unwrap-the-model-and-bake-its = Déplier le modèle et précalculer ses couleurs, ses normales ou sa lumière dans des textures (Ctrl + B)
window-shader-exercises-edit-compare-with-the = Exercices sur les shaders : modifier, comparer à la bonne réponse et vérifier
window-files = Fichiers
window-open-2 = Ouvrir...
window-open-a-model-or-a-scene = Ouvrir un modèle ou une scène (Ctrl + O)
window-save-the-picture-or-the-scene = Enregistrer l'image ou la scène, précalculer des textures
window-samples = Exemples
window-built-in-models-and-scenes = Modèles et scènes intégrés
window-recent = Récents
window-recently-opened-files = Fichiers ouverts récemment
window-exercises = Exercices
window-brdf-bench = Banc de BRDF
window-undo-ctrl-z = Annuler (Ctrl + Z)
window-redo-ctrl-y = Rétablir (Ctrl + Y)
window-frame-all-f = Tout cadrer (F)
window-keyboard-shortcuts-2 = Raccourcis clavier (?)
window-light-or-dark-theme-t = Thème clair ou sombre (T)
window-bake-textures = Précalculer des textures...
window-copy-the-picture = Copier l'image
window-a-link-to-this-page-with = Un lien vers cette page qui contient la scène : modèles d'exemple, lumières, caméra et tous les réglages
window-copy-a-link-to-the-scene = Copier un lien vers la scène
window-six-faces-with-hard-edges-flat = Six faces aux arêtes vives : les ombrages plat et de Phong donnent la même image
window-a-rectangle-that-emits-the-light = Un rectangle qui émet la lumière d'une image
window-few-triangles-with-one-normal-per = Peu de triangles, avec une normale par face : c'est là que les ombrages diffèrent le plus
window-few-triangles-with-averaged-normals-interpolation = Peu de triangles, avec des normales moyennées : l'interpolation cache les arêtes
window-many-triangles-all-shadings-look-the = Beaucoup de triangles : tous les ombrages donnent la même image
window-several-materials-and-textures-on-one = Plusieurs matériaux et textures sur une table
window-blender-s-monkey-head = La tête de singe de Blender
window-each-simplification-of-the-rendering-equation-2 = Chaque simplification de l'équation de rendu coûte peu ici
window-objects-that-reflect-and-refract-their = Des objets qui réfléchissent et réfractent ce qui les entoure
window-each-simplification-of-the-rendering-equation = Chaque simplification de l'équation de rendu coûte cher ici
window-the-scene-of-exercise-07 = La scène de l'exercice 07
window-a-directional-a-point-and-a = Une lumière directionnelle, une lumière ponctuelle et un spot côte à côte
window-flat-gouraud-and-phong-shading-side = Ombrages plat, de Gouraud et de Phong côte à côte
window-three-spheres-under-three-lights = Trois sphères sous trois lumières

## platform/desktop/bake

window-the-textures-could-not-be-baked = les textures n'ont pas pu être précalculées : le travail s'est terminé de façon inattendue

## platform/desktop/check

window-the-check-could-not-be-started = la vérification n'a pas pu être lancée : { $error }
window-the-check-ended-without-an-answer = la vérification s'est terminée sans réponse : réessayez

## platform/desktop/drafts

window-a-folder-in-could-not-be = un dossier dans `{ $root }` n'a pas pu être créé : { $error }

## platform/desktop/fonts

window-install-a-font-of-this-script-2 = installez une police de cette écriture et redémarrez gonio
window-install-a-font-of-this-script = installez une police de cette écriture, sur Debian et Ubuntu par `apt-get install { $packages }`, et redémarrez gonio

## platform/desktop/mod

window-the-gonio-program-was-not-found-2 = le programme gonio n'a pas été trouvé : lancez `gonio lab check` dans un terminal
window-the-gonio-program-was-not-found = le programme gonio n'a pas été trouvé
window-there-is-no-home-folder-home = il n'y a pas de dossier personnel (HOME n'est pas défini)
window-gonio-render-draws-without-a-window = `gonio render` dessine sans fenêtre
window-there-is-no-display-neither-wayland = il n'y a pas d'affichage : ni WAYLAND_DISPLAY ni DISPLAY n'est défini ; { $instead }
window-the-window-needs-which-is-not = la fenêtre a besoin de { $library }, qui n'est pas installé : sur Debian et Ubuntu, lancez `apt-get install { $package }`
window-on-debian-and-ubuntu-apt-get = sur Debian et Ubuntu : apt-get install libgl1-mesa-dri libegl1 libxcursor1 libxi6 libxkbcommon-x11-0
window-the-window-could-not-be-opened = la fenêtre n'a pas pu être ouverte : { $words }
window-the-window-has-no-opengl = la fenêtre n'a pas OpenGL ({ $words }) ; { $packages } ; { $instead }
window-the-display-cannot-be-reached-check = l'affichage est inaccessible ({ $words }) ; vérifiez DISPLAY ou WAYLAND_DISPLAY, { $packages } ; { $instead }

## platform/desktop/open

window-there-are-no-files-in = il n'y a pas de fichiers dans { $places }
window-there-are-more-than-files-in = il y a plus de { $count } fichiers dans { $places } : n'ouvrez que ceux de l'exercice
window-is-too-large-for-an-exercise = `{ $path }` est trop gros pour un exercice : { $megabytes } Mo
window-cannot-be-read = impossible de lire `{ $folder }` : { $error }

## platform/desktop/stations

window-the-station-cannot-be-computed-the = la station ne peut pas être calculée : le travail s'est terminé de façon inattendue

## platform/desktop/storage

window-could-not-be-written = impossible d'écrire `{ $place }` : { $error }
window-no-such-folder-create-it-or = ce dossier n'existe pas : créez-le ou choisissez-en un autre
window-permission-denied-choose-another-folder = permission refusée : choisissez un autre dossier
window-this-is-a-folder-add-a = c'est un dossier : ajoutez un nom de fichier
window-the-file-name-is-missing = il manque le nom du fichier
window-the-disk-is-full = le disque est plein
window-choose-another-place = { $error } : choisissez un autre emplacement

## platform/desktop/trace

window-the-scene-could-not-be-traced = la scène n'a pas pu être tracée : le lancer de chemins s'est terminé de façon inattendue

## platform/desktop/trial

window-the-shader-test-could-not-be-2 = le test du shader n'a pas pu être lancé : { $why }
window-the-test-of-these-shaders-ended = le test de ces shaders s'est terminé sans réponse
window-the-test-of-this-shader-ended = le test de ce shader s'est terminé sans réponse
window-the-shader-test-could-not-be = le test du shader n'a pas pu être surveillé : { $why }
window-the-shader-could-not-be-tested = le shader n'a pas pu être testé hors de la fenêtre
window-this-shader-crashed-the-process-that = Ce shader a fait planter le processus qui le teste, donc la fenêtre ne le dessine pas : cherchez de très grands tableaux, des expressions très longues ou des imbrications profondes
window-this-shader-needs-about-seconds-for = { NUMBER($seconds) ->
    [one] Ce shader a besoin d'environ { $seconds } seconde pour une seule image, donc la fenêtre ne le dessine pas : cherchez une boucle qui a trop d'itérations
    *[other] Ce shader a besoin d'environ { $seconds } secondes pour une seule image, donc la fenêtre ne le dessine pas : cherchez une boucle qui a trop d'itérations
}
window-this-shader-failed-in-a-test = Ce shader a échoué dans un test, donc la fenêtre ne le dessine pas : { $why }
window-the-process-that-tests-shaders-gave = le processus qui teste les shaders n'a pas donné de réponse
window-this-shader-did-not-finish-within = Ce shader n'a pas terminé en { $seconds } secondes dans un test, donc la fenêtre ne le dessine pas : cherchez une boucle sans fin
window-this-shader-took-more-than-1 = Ce shader a pris plus de 1 Go de mémoire dans un test, donc la fenêtre ne le dessine pas : cherchez de très grands tableaux, ou des macros qui se multiplient entre elles
window-the-test-of-this-shader-was = le test de ce shader a été arrêté

## platform/desktop/worker

window-the-process-has-no-input-or = le processus n'a pas d'entrée ou pas de sortie
window-the-check-could-not-be-monitored = la vérification n'a pas pu être surveillée : { $error }
window-the-check-was-stopped = la vérification a été arrêtée
window-the-answer-of-the-check-could = la réponse de la vérification n'a pas pu être comprise : { $error }

## platform/mod

window-install-a-font-of-this-script-3 = installez une police de cette écriture et rechargez la page
window-checks-are-not-available-here-run = les vérifications ne sont pas disponibles ici : lancez `gonio lab check` en ligne de commande
window-renderdoc-is-not-loaded-preload = RenderDoc doit être chargé au démarrage de la fenêtre : lancez `LD_PRELOAD=librenderdoc.so gonio view` pour capturer des trames
window-renderdoc-is-not-loaded-launch = RenderDoc doit être chargé au démarrage de la fenêtre : lancez `gonio view` depuis RenderDoc (Launch Application) pour capturer des trames
window-renderdoc-does-not-run-here = RenderDoc ne fonctionne pas ici, seulement sous Linux et Windows
window-there-are-no-processes-here = il n'y a pas de processus ici
window-this-shader-is-not-drawn-because = Ce shader n'est pas dessiné, car il risque de ne jamais se terminer : { $reason }

## platform/web/bake

window-the-textures-could-not-be-baked-3 = les textures n'ont pas pu être précalculées : { $error }
window-the-textures-could-not-be-baked-2 = les textures n'ont pas pu être précalculées : la réponse du worker est endommagée

## platform/web/document

window-the-page-has-no-window = la page n'a pas de fenêtre
window-the-browser-does-not-allow-choosing = le navigateur ne permet pas de choisir des fichiers : déposez-les sur la page
window-could-not-be-downloaded = impossible de télécharger `{ $name }` : { $error }
window-this-browser-has-no-storage-for = ce navigateur n'a pas de stockage pour cette page
window-the-browser-s-storage-for-this = le stockage du navigateur pour cette page est plein

## platform/web/mod

window-only-built-in-files-can-be = seuls les fichiers intégrés peuvent être lus ici
window-a-web-page-cannot-open-by = une page web ne peut pas ouvrir { $names } par son chemin : déposez le fichier sur la page
window-the-verdict-could-not-be-understood = le verdict n'a pas pu être compris : { $error }

## platform/web/stations

window-the-worker-s-answer-is-damaged = la réponse du worker est endommagée
window-the-station-cannot-be-computed = la station ne peut pas être calculée : { $reason }

## platform/web/trace

window-the-scene-could-not-be-traced-2 = la scène n'a pas pu être tracée : { $error }

## saving

window-picture-as-displayed-png = Image telle qu'affichée (PNG)
window-picture-at-the-scene-s-resolution = Image à la résolution de la scène (PNG)
window-linear-light-exr = Lumière linéaire (EXR)
window-scene-toml = Scène (TOML)
window-renderdoc-capture-rdc = Capture RenderDoc (RDC)
window-plot-svg = Graphique (SVG)
window-plot-png = Graphique (PNG)
window-obj-and-png = OBJ et PNG

## session/equation

window-a-ambient-light-the-same-from = A, la lumière ambiante : la même dans toutes les directions, jamais atténuée
window-e-the-light-that-the-surface = E, la lumière que la surface émet
window-light-from-the-environment-diffuse-and = La lumière de l'environnement : lumière diffuse et réflexion brillante
window-diff-k-d-the-diffuse-term = diff k_d, le terme diffus : le même dans toutes les directions de visée
window-k-s-spec-i-the-specular = k_s spec_i, le terme spéculaire : le reflet
window-l-i-the-colour-of-light = L_i, la couleur de la lumière i multipliée par son intensité
window-att-i-attenuation-the-decrease-of = att_i, l'atténuation : la décroissance de la lumière avec la distance
window-spot-i-the-soft-edge-of = spot_i, le bord progressif du cône d'un spot
window-n-l-i-the-cosine-of = <N.L_i>, le cosinus de l'angle entre la normale et la direction de la lumière, borné à 0

## session/hints

window-tip-click-the-picture-to-see = Astuce : cliquez sur l'image pour voir tous les nombres de l'équation en ce pixel.
window-tip-drag-a-lamp-in-the = Astuce : faites glisser une lampe dans l'image.
window-tip-click-a-term-of-the = Astuce : cliquez sur un terme de l'équation pour le désactiver.

## session/mod

window-lights = Lumières
window-objects = Objets
window-camera = Caméra
window-picture = Image
window-probe = Sonde
window-compare = Comparer
window-frame = Trame
window-shaders = Shaders
window-bake = Baking
window-lights-each-adds-one-summand-to = Les lumières : chacune ajoute un terme à la somme de l'équation
window-models-their-transformations-and-materials = Les modèles, leurs transformations et leurs matériaux
window-camera-parameters-and-matrices = Paramètres et matrices de la caméra
window-environment-background-exposure-and-tone-mapping = Environnement, arrière-plan, exposition et mappage des tons
window-the-light-equation-at-one-pixel = L'équation d'éclairage en un pixel, en nombres
window-the-scene-with-up-to-four = La scène avec jusqu'à quatre réglages côte à côte
window-the-opengl-calls-that-drew-this = Les appels OpenGL qui ont dessiné cette image
window-your-own-shaders-and-the-values = Vos propres shaders et les valeurs de leurs uniforms
window-textures-for-new-texture-coordinates-baked = Textures pour de nouvelles coordonnées de texture, précalculées à partir de la scène

## session/own_shaders

window-the-graphics-were-reset-while-your = le contexte graphique a été réinitialisé pendant que vos shaders étaient dessinés : ils ont peut-être une boucle sans fin ; rouvrez-les après une modification
window-cannot-read-the-texture = impossible de lire la texture { $path } : { $error }

## session/probing

window-light = lumière { $index }
window-light-of-this-source-that-only = Lumière de cette source que seule la surface visible a diffusée
window-light-that-no-surface-scattered-of = Lumière qu'aucune surface n'a diffusée : celle de ce qui brille par lui-même, ou de l'arrière-plan
window-object = objet { $object }
window-k-a-times-the-ambient-light = k_a fois la lumière ambiante
window-first-bounce = premier rebond
window-light-that-two-surfaces-scattered = Lumière que deux surfaces ont diffusée
window-the-rest = le reste
window-light-that-more-than-two-surfaces = Lumière que plus de deux surfaces ont diffusée
window-the-sum-which-is-the-traced = La somme, qui est le pixel de l'image tracée
window-standard-error = erreur type
window-of-the-total-how-far-it = Du total : son écart possible à la vraie valeur

## shortcuts

window-in-the-picture = Dans l'image
window-the-window = La fenêtre
window-in-an-exercise-or-with-your = Dans un exercice, ou avec vos propres shaders
window-drag = Glisser
window-orbit-around-the-target = tourner autour de la cible
window-shift-drag = Shift + glisser
window-right-button-drag = Bouton droit + glisser
window-look-around = regarder autour de soi
window-wheel = Molette
window-w-a-s-d-z-q = w a s d, z q s d, flèches
window-fly-e-and-c-move-up = voler ; e et c : monter et descendre ; Shift : plus vite
window-frame-all = tout cadrer
window-space = Espace
window-play-or-pause-the-animation = lancer l'animation ou la mettre en pause
window-probe-the-pixel-under-the-pointer = sonder le pixel sous le pointeur ; un clic l'épingle, Esc le désépingle
window-show-the-camera-and-its-frustum = afficher la caméra et son volume de vision vus de l'extérieur
window-bounding-boxes = boîtes englobantes
window-ground-with-a-contact-shadow = sol avec une ombre de contact
window-checkerboard-of-the-texture-coordinates = damier des coordonnées de texture
window-overdraw-fragments-per-pixel = surdessin : fragments par pixel
window-the-traced-picture-the-rendering-equation = l'image tracée : l'équation de rendu à la place de l'équation d'éclairage
window-double-click-on-a-value = Double-clic sur une valeur
window-reset-it-to-its-default = revenir à sa valeur par défaut
window-ctrl-plus-ctrl-minus = Ctrl + plus, Ctrl + moins
window-enlarge-or-shrink-the-interface-ctrl = agrandir ou réduire l'interface ; Ctrl + 0 rétablit sa taille
window-switch-between-light-and-dark-theme = passer du thème clair au thème sombre, ou l'inverse
window-show-this-list = afficher cette liste
window-close-the-open-dialog = fermer le dialogue ouvert
window-open-files-or-drop-them-on = ouvrir des fichiers (ou les déposer sur la fenêtre)
window-save-the-scene = enregistrer la scène
window-bake-textures-2 = précalculer des textures
window-save-the-picture = enregistrer l'image
window-check-the-shaders-of-an-exercise = vérifier les shaders d'un exercice
window-find-in-the-text-go-to = chercher dans le texte, aller à l'occurrence suivante ou précédente
window-indent-the-selected-lines-in-the = indenter les lignes sélectionnées dans l'éditeur, ou revenir d'un cran
window-make-the-selected-lines-comments-or = mettre les lignes sélectionnées en commentaire, ou les remettre en code
window-leave-the-editor-then-tab-goes = quitter l'éditeur ; Tab passe alors au contrôle suivant
window-click-on-the-picture-f9 = Clic sur l'image, F9
window-show-each-line-s-values-at = afficher les valeurs de chaque ligne en ce pixel, ou au milieu de l'image
window-next-or-previous-step-over-calls = pas suivant ou précédent, par-dessus les appels ; aussi Alt + Bas, Alt + Haut
window-next-or-previous-step-into-calls = pas suivant ou précédent, en entrant dans les appels ; aussi Alt + Droite, Alt + Gauche
window-shift-alt-arrows = Shift + Alt + flèches
window-move-the-pinned-pixel = déplacer le pixel épinglé
window-value-and-picture-of-the-expression = valeur et image de l'expression sous le curseur ; le pointeur les montre aussi
window-the-picture = l'image
window-views-in-place-of-the-picture = Vues à la place de l'image

## truth

window-not-possible-here = impossible ici
window-the-first-paths-are-on-their = les premiers chemins sont en cours de calcul
window-1-path-per-pixels = 1 chemin pour { $paths } pixels
window-1-path-per-pixel = 1 chemin par pixel
window-paths-per-pixel = { $paths } chemins par pixel
window-paths-and-error = { $paths }, erreur { $percent } %

## widgets/color

window-linear = linéaire { $r }, { $g }, { $b }
window-double-click = Double-clic : { $default }
window-color-text = texte de la couleur
window-rrggbb-srgb-or-r-g-b = #rrggbb (sRGB), ou r,g,b ou un seul nombre (linéaire, peut dépasser 1)

## widgets/number

window-from-to = De { $low }{ $unit } à { $high }{ $unit }
window-at-least = Au moins { $low }{ $unit }
window-double-click-2 = Double-clic : { $default }{ $unit }

## widgets/parameters

window-largest-channel = { $name }, canal le plus grand

## short words

window-copied = copié
window-pan = déplacer la vue
window-zoom = zoomer
window-redo = rétablir
window-undo = annuler
window-language = Langue
window-the-model-is-not-converted-yet = le modèle n'est pas encore converti : attendez qu'il soit lu
window-file = Fichier
window-what-the-model-s-file-holds = Ce que contient le fichier du modèle, et les fichiers qu'il nomme
window-gallery = Galerie...
window-every-technique-on-several-models = Chaque technique sur plusieurs modèles, en scènes à ouvrir
window-convert-the-environment = Convertir l'environnement...
window-the-environment-as-six-faces = L'environnement en six faces, en croix, en panorama ou en KTX2, et la vérification de son orientation
window-environment = Environnement
window-faces-of-the-environment = L'environnement en six faces et en panorama, vérifié et converti
