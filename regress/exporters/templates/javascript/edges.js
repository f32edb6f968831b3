/* Ends of the edges whose lengths are measured; the last pair spans the face's width. */
const edges = $edges;
