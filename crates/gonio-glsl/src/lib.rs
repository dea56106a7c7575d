//! GLSL as it is written: tokens, syntax tree and types, each with its place in the source; and the same text for another
//! version of the language. Knows no OpenGL and opens no file.
