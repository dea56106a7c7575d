# The panel of files.

## app/inspector

file-no-model-is-chosen-choose-one = aucun modèle n'est choisi : choisissez-en un dans l'onglet Fichier
file-saved = enregistré : { $place }
file-belongs-to-the-open-scene-and = `{ $own }` appartient à la scène ouverte et serait remplacé : enregistrez sous un autre nom

## inspector

file-the-work-ended-unexpectedly-this-is = le travail s'est arrêté de façon inattendue ; c'est un défaut de gonio, merci de le signaler
file-cannot-be-written = `{ $place }` ne peut pas être écrit : { $error }

## panels/file/contents

file-unpacked = { $name }, { $bytes }, { $unpacked } une fois décompressé
file-format = Format
file-content = Contenu
file-exporter = Exportateur
file-elements = Éléments
file-parts = Parties
file-no-name = (sans nom)
file-the-default-material = le matériau par défaut
file-triangles-2 = { $count } triangles, { $material }
file-triangles = Triangles
file-vertices = Sommets
file-equal-corners-merged = { $count } (coins égaux fusionnés)
file-bounds = Limites
file-from-to-size = { $name } de { $low } à { $high }, taille { $size }
file-from-the-file = du fichier
file-from-the-file-averaged-where-missing = du fichier, moyennées là où elles manquent
file-one-per-triangle = une par triangle
file-averaged-over-adjacent-faces-weighted-by = moyennées sur les faces voisines, pondérées par les angles
file-normals = Normales
file-to = { $least } à { $greatest }
file-texture-coordinates = Coordonnées de texture
file-vertex-colours = Couleurs des sommets
file-off-everywhere = désactivés partout
file-smoothing-groups = Groupes de lissage
file-memory = Mémoire
file-closed-front-faces-outside = fermée, faces avant à l'extérieur
file-closed-but-not-every-piece-has = fermée, mais toutes les pièces n'ont pas leurs faces avant à l'extérieur
file-surface = Surface
file-pieces = Pièces
file-genus = Genre
file-area = Aire
file-volume = Volume
file-no-choice-of-front-faces-is = aucun choix de faces avant n'est cohérent
file-orientation = Orientation
file-triangles-must-be-flipped-to-make = { $count } triangles sont à retourner pour que toutes les faces avant soient cohérentes
file-triangles-without-area = Triangles d'aire nulle
file-duplicate-triangles = Triangles en double
file-triangles-back-to-back = Triangles dos à dos
file-edges-of-one-triangle-only = Arêtes d'un seul triangle
file-edges-of-more-than-two-triangles = Arêtes de plus de deux triangles
file-edges-between-a-front-and-a = Arêtes entre une face avant et une face arrière
file-points-where-surfaces-merely-touch = Points où des surfaces ne font que se toucher
file-the-first-at = { $count }, le premier en { $place }
file-lights-and-cameras = Lumières et caméras
file-ambient-light = lumière ambiante
file-directional-light = lumière directionnelle
file-point-light = lumière ponctuelle
file-spot-light = projecteur
file-colour-intensity = { $kind }, couleur { $color }, intensité { $intensity }
file-camera-high = caméra, { $degrees }° de haut
file-camera-with-parallel-projection = caméra à projection parallèle
file-interpreted-differently-by-other-programs = Interprété autrement par d'autres programmes
file-elsewhere = Ailleurs : { $others }
file-here = Ici : { $here }
file-bytes = { $count } octets
file-kb = { $size } ko
file-mb = { $size } Mo
file-gb = { $size } Go

## panels/file/lines

file-close-the-text = Fermer le texte
file-next-line = Ligne suivante
file-previous-line = Ligne précédente
file-number-of-the-marked-line = Numéro de la ligne marquée
file-lines = { $file }, { $count } lignes
file-line-2 = ligne { $line }
file-line = { $file }, ligne { $marked } : { $text }

## panels/file/materials

file-materials = Matériaux
file-triangles-3 = { $name }, { $count } triangles
file-not-used = inutilisé

## panels/file/mod

file-no-file-is-open = Aucun fichier n'est ouvert.
file-the-file-is-being-read = Lecture du fichier...
file-file = Fichier
file-missing = { $name } ({ $lacks } manquants)
file-the-model-as-its-file-has = Le modèle tel qu'il est dans son fichier, sans les changements faits dans la scène
file-save-as = Enregistrer en
file-one-file-with-the-model-its = Un fichier avec le modèle, ses matériaux et ses textures
file-the-model-as-obj-with-its-2 = Le modèle en .obj avec son .mtl et ses textures, dans un fichier ZIP
file-the-model-as-obj-with-its = Le modèle en .obj, avec son .mtl et ses textures à côté
file-vertices-triangles-and-vertex-colours-ply = Sommets, triangles et couleurs des sommets ; PLY n'a pas de matériaux
file-save-the-model-as = Enregistrer le modèle en { $title }
file-the-model-is-being-converted = Conversion du modèle...
file-warnings-and-notes = Avertissements et remarques
file-line-3 = { $name }, ligne { $line }
file-show-line-of = Montrer la ligne { $line } de { $name }
file-more-are-not-shown-gonio-inspect = { $count } autres ne sont pas affichés ; `gonio inspect --json` les donne tous.

## panels/file/names

file-the-textures-are-inside-the-model = Les textures sont dans le fichier du modèle.
file-the-file-that-the-model-names-2 = Le fichier que nomme le modèle a été trouvé.
file-all-files-that-the-model-names = Les { $all } fichiers que nomme le modèle ont été trouvés.
file-the-file-that-the-model-names = Le fichier que nomme le modèle manque.
file-one-of-files-that-the-model = Un des { $all } fichiers que nomme le modèle manque.
file-of-files-that-the-model-names = { $absent } des { $all } fichiers que nomme le modèle manquent.
file-inside-the-file = dans le fichier, { $size }
file-drop-the-missing-files-on-the = Déposez les fichiers manquants sur la fenêtre, ou choisissez-les : ils sont trouvés par leur nom, quel que soit le dossier où le modèle les cherche.
file-choose-files = Choisir des fichiers...
file-of-x-texels = { $key } de { $material }, { $width } x { $height } texels
file-of = { $key } de { $material }
file-not-read-2 = non lu
file-found-as = Trouvé : { $path }
file-not-read = Non lu : { $refused }
file-missing-there-is-no-folder-to = Manquant ; il n'y a pas de dossier où chercher
file-missing-searched = Manquant ; cherché dans { $folders }
file-show-the-text = Montrer le texte
file-files = Fichiers
file-model-of-one-object = modèle d'un objet
file-model-of-objects = modèle de { $objects } objets
file-files-that-it-names-and-that = Fichiers qu'il nomme et qui manquent : { $lacks }
file-show-its-content = Montrer son contenu
file-brdf-of-an-object = BRDF d'un objet
