namespace gonio {}
