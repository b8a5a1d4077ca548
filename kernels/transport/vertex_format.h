// Which of the two layouts vertices of sub-paths have in memory.
#ifndef PELLUCID_TRANSPORT_VERTEX_FORMAT_H
#define PELLUCID_TRANSPORT_VERTEX_FORMAT_H

#include "shared/layout.h"

#if INTG_COMPACT
typedef CompactVertex StoredVertex;
#else
typedef PathVertex StoredVertex;
#endif

#endif
